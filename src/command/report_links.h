// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the summary of a run about contacts, links, and columns that are struck.
#ifndef JOSTLE_REPORT_LINKS_H
#define JOSTLE_REPORT_LINKS_H

#include "command/report_summary.h"

void report_links_contacts(struct report_summary *s);
void report_links_links(struct report_summary *s);
void report_links_columns(struct report_summary *s);

#endif
