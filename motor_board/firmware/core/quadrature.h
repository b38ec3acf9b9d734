/* Edges of both channels: two or four counts in a period of channel A, by the table of transitions. */
#ifndef QUADRATURE_H
#define QUADRATURE_H

#include <stdbool.h>
#include <stdint.h>

#include "edge_timer.h"

#define QUADRATURE_A 1u /* bits of `lines` */
#define QUADRATURE_B 2u

/* Begins to count `fold` edges in a period of A (1: as edge_timer_rise and edge_timer_fall do), with the lines at these
 * levels. The count goes on from where it is. */
void quadrature_start(struct edge_timer *timer, uint8_t fold, uint8_t lines);

/* A's interrupt found the lines at these levels; `counter` is the time of A's flank.
 *
 * With fold 4 B's level is the one that B's own interrupt saw last: that interrupt comes first if both wait, so that a B
 * that differs has changed after A. With fold 2 only A's flanks count, and B tells the direction. */
void quadrature_see_a(struct edge_timer *timer, uint16_t counter, bool pending, uint8_t lines);

/* Fold 4: B's interrupt found the lines at these levels at `counter`, `late` ticks at least after the flank. A change of
 * both lines is an error, and no motion: which one came first cannot be told. A change of A alone is left to A's
 * interrupt, which has its exact time. */
void quadrature_see_b(struct edge_timer *timer, uint16_t counter, bool pending, uint8_t lines, uint8_t late);

/* The encoder at `now` [tick], as edge_timer_at says it.
 *
 * An edge of B has the time of its interrupt, some microseconds late. Where edges are so close that this matters, the
 * edge before it is reported, A's, with its own count: count and time of a report always belong together. The period is
 * the mean over the latest period of A, whatever duty cycle and phase its lines have; after a reversal, over what there
 * is since. */
struct edge quadrature_at(const struct edge_timer *timer, uint32_t now);

#endif
