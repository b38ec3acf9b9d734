/* Encoder edges on a 32-bit clock, out of a 16-bit counter with input capture. */
#ifndef EDGE_TIMER_H
#define EDGE_TIMER_H

#include <stdbool.h>
#include <stdint.h>

/* Edges, a power of two: up to 3 after the sample, one skipped, a period of A before it; and those that come meanwhile. */
#define EDGE_TIMER_KEPT 16u
#define EDGE_REVERSE 1u
#define EDGE_UNDOES 2u
#define EDGE_LATE 4u /* its time is that of an interrupt, not of the capture unit */

/* What is known of the encoder at an instant. */
struct edge {
    uint32_t count;  /* wraps; with two channels backward edges count down */
    uint32_t time;   /* [tick] of the latest edge */
    uint32_t period; /* [tick] from the edge before it; 0: there is none, it is too long ago, or one of the two is an edge
                        that was taken back */
    bool valid;      /* there is a latest edge, and it is less than 2^31 ticks old */
    bool reverse;    /* it was passed backward */
};

struct edge_timer {
    uint16_t overflows; /* upper half of the clock */
    uint32_t count;
    uint8_t newest, known;          /* index of the newest edge kept; how many are */
    uint8_t way[EDGE_TIMER_KEPT];   /* EDGE_REVERSE: passed backward; EDGE_UNDOES: takes back the edge before it */
    bool inside, entered_reverse; /* two channels: A is high; how its rising edge was passed */
    uint8_t fold;   /* edges counted in a period of A; 0 and 1: one polarity (quadrature.h has the others) */
    uint8_t lines;  /* their levels, as far as edges have been counted */
    uint8_t errors; /* changes of both lines at once, and times at which edges were not heard; wraps */
    uint32_t time[EDGE_TIMER_KEPT]; /* [tick] last, see tick.c */
};

/* The 32-bit time of a 16-bit counter value.
 *
 * `pending`: the counter has overflowed and `overflows` does not know yet. The value was read (or captured) before that
 * overflow if it is in the upper half, after it if in the lower half. This holds as long as an overflow waits less than
 * half a turn of the counter (16 ms at 0.5 us) for its interrupt. */
uint32_t edge_timer_extend(uint16_t overflows, uint16_t counter, bool pending);

/* Keeps an edge at a 32-bit time, as the newest. */
void edge_timer_keep(struct edge_timer *timer, uint32_t time, uint8_t way);

/* Edges were not heard, the latest of them at `time`: those kept are taken for the latest ones, as far apart as they are. So
 * a motor too fast to be counted keeps its speed in place of none, and the next edge's period is its own. Not if it is
 * older than the newest one. */
void edge_timer_move(struct edge_timer *timer, uint32_t time);

/* How many of the edges kept came after `now` [tick]; at most 3. */
uint8_t edge_timer_later(const struct edge_timer *timer, uint32_t now);

/* The counter has overflowed. */
void edge_timer_overflow(struct edge_timer *timer);

/* A rising edge of the only channel was captured at `counter`. */
void edge_timer_capture(struct edge_timer *timer, uint16_t counter, bool pending);

/* Two channels: a rising edge of A was captured at `counter`; `reverse`: B is high. */
void edge_timer_rise(struct edge_timer *timer, uint16_t counter, bool pending, bool reverse);

/* Two channels: A has fallen. Rising edges are what counts: forward the one flank of a hole (B low), backward the other
 * (B high). If A falls with B as it was when A rose, the shaft has come out where it went in, and the edge is taken
 * back: a shaft that dithers over one flank counts to and fro. Falling edges need no exact time; they are seen by their
 * own interrupt, whose order with that of a rising edge is not certain, hence:
 * a falling edge without a rising one before it is none, and a rising one without a falling one before it makes up for
 * that (the line was low too shortly to be seen). */
void edge_timer_fall(struct edge_timer *timer, uint16_t counter, bool pending, bool b_high);

/* The encoder at `now` [tick].
 *
 * Edges captured between a sample's instant and its interrupt belong to the next sample; up to three of them are
 * told apart. Should a second edge overwrite the capture register before the first one's interrupt has read it, both come
 * with the same time: both count, and the period is that of the pair before. */
struct edge edge_timer_at(const struct edge_timer *timer, uint32_t now, bool two_channels);

/* Forgets edges so old that their time could be taken for a later one; to be called at least every 2^30 ticks. */
void edge_timer_forget(struct edge_timer *timer, uint32_t now);

#endif
