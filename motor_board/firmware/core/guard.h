/* The motor's current, watched: a peak, and what lasts (I2t), switch the output off. */
#ifndef GUARD_H
#define GUARD_H

#include <stdbool.h>
#include <stdint.h>

#include "wire.h"

#define GUARD_UNKNOWN 0xFFFFu /* no conversion since the last tick */

struct guard {
    struct wire_protect limits;
    uint16_t current; /* [step] beside zero, either way, of the latest conversion */
    uint8_t above;    /* conversions in a row above `most` */
    uint32_t heat;    /* as `budget` */
    bool tripped;     /* the latest way off was this */
};

/* Takes limits; 0 as `most` watches nothing. */
void guard_set(struct guard *guard, const struct wire_protect *limits);

/* At a sample: whether its current [step at A1], after a period [tick], has to switch the output off. */
bool guard_check(struct guard *guard, uint16_t steps, uint32_t period);

#endif
