# SPDX-License-Identifier: GPL-3.0-or-later
# Rows `what TAB unit TAB expected TAB computed` to rows of the Markdown table `name`.
{
    printf "%s\t| %s | %s | %s | %s | %s |\n", name, $1, $2, number($3, digits), number($4, digits),
        small(relative($3, $4), 1e-12)
}
