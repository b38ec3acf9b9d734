/* The whole board but its registers: what happens at an edge, at a sample tick, and with a frame.
 *
 * Interrupts call device_capture, device_overflow and the three parts of the compare interrupt. The main loop calls the others; those marked
 * "locked" touch what the interrupts touch and are to be called with interrupts off. All times are in ticks of the one
 * counter that captures edges.
 */
#ifndef DEVICE_H
#define DEVICE_H

#include <stdbool.h>
#include <stdint.h>

#include "edge_timer.h"
#include "frame.h"
#include "guard.h"
#include "output.h"
#include "quadrature.h"
#include "wire.h"

#define DEVICE_LONGEST_PERIOD 0x1000000ul /* [tick] */
#define DEVICE_LONGEST_STEP 0x2800u       /* [tick] between two compare interrupts; below one turn of the counter */
#define DEVICE_AHEAD 100u                 /* [tick] in which the counter can be set to the next one */

/* What does not change while the board runs. */
struct device_config {
    uint8_t board;
    uint16_t board_id, edges_per_revolution;
    uint8_t channels;
    uint16_t tick_ns, top;
    uint32_t ticks_per_ms, shortest_period, first_period; /* [tick] */
    uint32_t lead; /* [tick] from the compare interrupt to the pins following it: the sample is at the latter */
    uint16_t first_timeout;                               /* [ms] */
    uint8_t first_decay;
    bool senses_current;    /* `sensed` frames in place of telemetry */
    uint16_t silent_top[2]; /* by decay: duty of full voltage with silent PWM; 0: it cannot be had */
};

struct device {
    const struct device_config *config;
    struct edge_timer edges;
    struct output output;
    struct guard guard;
    uint8_t reset_cause;
    uint32_t period;        /* [tick] between samples */
    uint32_t compare, tick; /* [tick] of the next compare interrupt, of the next sample */
    uint32_t latest;        /* [tick] of the latest sample */
    uint16_t timeout;               /* [ms] */
    uint16_t supply;                /* [mV] */
    uint16_t current, sampled_current; /* [5 V/1024] since the latest tick, and of that tick's sample */
    struct wire_telemetry sample;   /* what was true at the latest tick */
    uint8_t quadrature;             /* asked for; the pins' interrupts have to follow it by quadrature_start */
    uint8_t pwm;                    /* of the bridge, from the next configure on */
    bool sampled, asked, pinged, set_up, guarded; /* a telemetry, hello, pong, features, protection frame is due */
    struct wire_ping ping;
    uint32_t ping_received;
    uint16_t seq, dropped_samples;
};

/* A frame on its way out: `data` has room for header, body and CRC. */
struct device_frame {
    uint8_t type, size;
    uint16_t seq;
    uint8_t data[WIRE_LONGEST_FRAME];
};

/* Power-up: off, and a hello to send. */
void device_start(struct device *device, const struct device_config *config, uint16_t start, uint8_t reset_cause);

void device_overflow(struct device *device);
void device_capture(struct device *device, uint16_t counter, bool overflow_pending); /* one channel */
void device_rise(struct device *device, uint16_t counter, bool overflow_pending, bool b_high); /* two channels */
void device_fall(struct device *device, uint16_t counter, bool overflow_pending, bool b_high); /* two channels */

/* The compare interrupt, in three parts. First: at a sample tick the newest command is latched, between ticks a missing
 * command is noticed. The pins have to follow device->output.duty. Returns whether it is a tick. */
bool device_latch(struct device *device);

/* Second: the counter value of the next compare interrupt. */
uint16_t device_next(struct device *device);

/* Whether the next compare interrupt was to come before `now`: where this one was held up, the counter may have passed it
 * before it was set to it, and would go round once more. */
bool device_is_behind(const struct device *device, uint32_t now);

/* Instead of that one, the counter value of the first that is ahead of `now`; samples before it are dropped. */
uint16_t device_catch_up(struct device *device, uint32_t now);

/* Third, at a tick, once device->latest has passed: the sample is written down. Long, and nothing waits for it:
 * interrupts for edges may come meanwhile, which is why it takes a copy of device->edges. */
void device_sample(struct device *device, const struct edge_timer *edges);

/* Locked: acts on a frame whose CRC was right and whose last byte came at `now`. False if it is none for a board. */
bool device_act(struct device *device, const struct frame *frame, uint32_t now);

/* Locked: takes the most urgent frame to send; false if there is none, or it has to wait until `quiet`: nothing else is
 * being sent, so that a pong can tell when it starts (at `now` [tick]). */
bool device_take(struct device *device, struct device_frame *frame, bool quiet, uint32_t now, uint16_t bad_frames);

#endif
