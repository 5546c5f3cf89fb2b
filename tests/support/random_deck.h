// SPDX-License-Identifier: GPL-3.0-or-later
// Decks made at random: two to four buildings with every contact and storey law, gaps from 0, steps
// from far below to far above the duration of a contact.
#ifndef JOSTLE_TEST_RANDOM_DECK_H
#define JOSTLE_TEST_RANDOM_DECK_H

#include <stddef.h>
#include <stdint.h>

// Writes deck number `seed` into text (size bytes).
void random_deck(uint64_t seed, char *text, size_t size);

// Writes row number `seed`: two to six buildings of one to eight floors that touch, up to 48
// contacts, each with a law of its own; of even numbers none may pull.
void random_deck_cluster(uint64_t seed, char *text, size_t size);

// Writes deck number `seed` of two buildings, of which the first is a frame, most with hinges of
// any storey law, and some with a wall, P-delta, a foundation or damping on the tangent stiffness.
// The floors of half of the pairs meet by level, and strike columns.
void random_deck_framed(uint64_t seed, char *text, size_t size);

// Deck number `seed` of random_deck with the lines `steps` in place of its integrator and step.
void random_deck_stepped(uint64_t seed, const char *steps, char *text, size_t size);

#endif
