/* What may reach the bridge: nothing before an enable, nothing stale (rules 2 to 4 of protocol/wire.yaml). */
#ifndef OUTPUT_H
#define OUTPUT_H

#include <stdbool.h>
#include <stdint.h>

#include "wire.h"

struct output {
    bool on, timed_out;
    uint8_t boot, latch;
    uint8_t decay, pwm;
    int16_t top;      /* full duty */
    int16_t newest;   /* duty commanded last; 0 while off */
    int16_t duty;     /* duty at the pins */
    uint16_t command; /* seq of the newest command, or of the enable */
    uint32_t heard;   /* [tick] of the newest command, or of the enable */
    uint32_t timeout; /* [tick] */
};

/* Switches off, latched: 0 V at the next output_latch. */
void output_off(struct output *output);

/* Switches on if the frame names the present boot and latch, or off. */
void output_enable(struct output *output, const struct wire_enable *frame, uint16_t seq, uint32_t now);

/* Takes a command, while on only one that is newer than the latest; it acts at the next output_latch, if on. */
void output_command(struct output *output, const struct wire_command *frame, uint16_t seq, uint32_t now);

/* Switches off if no command came for too long. */
void output_check(struct output *output, uint32_t now);

/* Latches the newest command; the pins have to follow `duty`. */
void output_latch(struct output *output);

#endif
