/* What the files of the emulated chip share. */
#ifndef INSIDE_H
#define INSIDE_H

#include <simavr/sim_avr.h>
#include <stdint.h>

#include "chip.h"
#include "layout.h"

#define VECTORS CHIP_VECTORS
#define EDGES 8192u /* powers of two */
#define BYTES 8192u

struct chip {
    avr_t *avr;
    const struct layout *layout;
    avr_io_t io; /* to be told of resets */
    avr_irq_t *edge, *edge_too, *direction, *input, *supply, *sense;

    struct { uint64_t cycle; uint8_t what; } edges[EDGES];
    size_t edge_out, edge_in;
    int a_high, b_high;
    uint64_t fall; /* cycle at which the encoder's pin goes low again; 0: it is low */

    uint8_t feed[BYTES];
    size_t feed_out, feed_in;
    uint64_t feed_next;
    int feed_stopped;

    uint8_t drain[BYTES];
    uint64_t drain_cycle[BYTES];
    size_t drain_out, drain_in;

    uint64_t until, settle, written; /* settle: when to look at pins that were written; 0: they were not */
    struct chip_pins pins;

    uint64_t sensing; /* cycle at which A1 began to be converted; 0: it is not, or the caller knows */

    uint32_t resets;
    uint64_t clock_zero; /* cycle at which the program last started timer 1 */
    int clocked;         /* it has, since the reset */

    struct chip_load loads[VECTORS];
    uint64_t raised[VECTORS], slept;
    struct { unsigned vector; uint64_t entered, nested; } running[VECTORS];
    unsigned depth;
};

/* traffic.c: edges and bytes at their cycles. */
void traffic_connect(struct chip *chip);
void traffic_arm(struct chip *chip); /* after a change of what is next, and after a reset */

/* load.c: what interrupts cost. */
void load_connect(struct chip *chip);

#endif
