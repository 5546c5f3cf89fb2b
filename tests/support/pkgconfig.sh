#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints jostle.pc from VERSION, PREFIX, LIBDIR, INCLUDEDIR and LIBS. There is no shared library, so
# that even `pkg-config --libs` without --static has to name what libjostle.a needs.
set -u

# A folder below the prefix is written relative to it, so that a copy elsewhere can be used with
# --define-variable=prefix=FOLDER.
below_prefix() {
    case $1 in
    "$PREFIX"/*) printf '${prefix}%s\n' "${1#"$PREFIX"}" ;;
    *) printf '%s\n' "$1" ;;
    esac
}

cat <<END
prefix=$PREFIX
libdir=$(below_prefix "$LIBDIR")
includedir=$(below_prefix "$INCLUDEDIR")

Name: jostle
Description: earthquake-induced pounding of multistorey shear buildings
Version: $VERSION
Cflags: -I"\${includedir}"
Libs: -L"\${libdir}" -ljostle $LIBS
END
