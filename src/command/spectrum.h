// SPDX-License-Identifier: GPL-3.0-or-later
// What the files of `jostle spectrum` share: what is asked for, and the records with their spectra.
#ifndef JOSTLE_COMMAND_SPECTRUM_H
#define JOSTLE_COMMAND_SPECTRUM_H

#include "command/command.h"
#include "command/deck_command.h"
#include "command/picture.h"
#include "command/printer.h"
#include "jostle/intensity.h"
#include "jostle/record.h"
#include "jostle/spectrum.h"
#include "motion/target.h"

// Periods on the command line: FROM:TO:N, evenly spaced by their logarithms, or a list.

struct periods {
    const double *value;  // (n) [s] ascending, 0 or 0.001 to 1000; NULL: none are given
    int n;
};

// Reads the value of `option`. What these two make is from `a`; they return EXIT_DONE or, after a
// message, the exit status.
int periods_parse(const struct command *c, const char *option, const char *text, struct arena *a,
                  struct periods *out);

// n >= 2 periods between two > 0.
int periods_range(const struct command *c, double from, double to, int n, struct arena *a,
                  struct periods *out);

enum { SPECTRUM_DECK = FORM_JSON + 1 };  // a further form: lines of a deck
enum spectrum_content { CONTENT_ALL, CONTENT_INTENSITIES };

struct spectrum_request {
    const char **path;  // (n_record)
    int n_record;
    struct record_request record;  // without its path
    double scale;                  // factor of every record
    double pga;                    // [m/s^2] each is scaled to; 0: `scale` holds
    const char *target;            // a file or a code whose spectrum each is scaled to; NULL: none
    struct periods match;          // those at which it is compared
    int n_component;               // 2: successive records are pairs with one factor; else 1
    int n_select;                  // records or pairs to choose; 0: all
    double least, most;            // limits of the factors of those chosen
    bool improve;                  // exchange chosen ones for the sake of the mean
    const double *damping;
    int n_damping;
    struct periods periods;
    int form;  // enum printer_form, or SPECTRUM_DECK
    enum spectrum_content content;
    struct picture_options picture;
    struct load_request load;  // the deck of a pounding force spectrum; path NULL: of records
    int n_thread;              // for it
};

// All in SI units.
struct spectrum_set {
    int n_read;                   // records before any were chosen for the target
    const char **name;            // (n_record) to show
    double *scale;                // (n_record)
    struct signal *ground;        // (n_record) [m/s^2]
    struct intensity *intensity;  // (n_record)
    struct spectra spectra;       // not computed for CONTENT_INTENSITIES
    struct target target;         // as what follows, only if one was asked for
    const char *target_name;
    const double *goal;  // (match.n) its values [m/s^2]
    struct match match;
};

extern const struct command command_spectrum;

// Reads the command line and calls spectrum_run with it. Both return the exit status.
int spectrum_command(int argc, char **argv);
int spectrum_run(struct spectrum_request *q, struct arena *a);

// Refuses records whose paths --deck cannot print. Returns EXIT_DONE or EXIT_INPUT.
int spectrum_check_deck(const struct spectrum_request *q);

// Reads the target, and completes the request by the periods at which it is compared. Returns GO_ON
// or the exit status.
int spectrum_read_target(struct spectrum_request *q, struct arena *a, struct spectrum_set *set);

// Prints the part of the help about the spectra of codes.
void spectrum_print_codes(void);

// Scales the grounds to the target. The records that are not chosen leave the request and the set.
int spectrum_match(struct spectrum_request *q, struct arena *a, struct spectrum_set *set,
                   struct error *e);

// spectra_compute, with its progress on the terminal.
int spectrum_compute(struct spectra *s, const struct signal *ground, struct arena *a,
                     struct error *e);

// Prints the lines of a deck that give the factors, or the factors, as spectrum_print does.
int spectrum_print_match(const struct spectrum_request *q, const struct spectrum_set *set);
void spectrum_print_deck(const struct spectrum_request *q, const struct spectrum_set *set);

// Prints the tables to stdout. Returns EXIT_DONE or, after a message, the exit status.
int spectrum_print(const struct spectrum_request *q, const struct spectrum_set *set);

// jostle spectrum --pounding: the pounding force spectrum of a deck.

// Runs the deck for every pair of periods, and prints or draws the largest contact forces. Returns
// the exit status.
int pounding_run(const struct spectrum_request *q, struct arena *a);

#endif
