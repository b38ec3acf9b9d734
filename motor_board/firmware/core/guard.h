/* The motor's current, watched: a peak, and what lasts (I2t), switch the output off. */
#ifndef GUARD_H
#define GUARD_H

#include <stdint.h>

#include "wire.h"

#define GUARD_UNKNOWN 0xFFFFu /* no conversion since the last tick */

enum guard_verdict { GUARD_WELL, GUARD_OVERCURRENT, GUARD_BLIND };

struct guard {
    struct wire_protect limits;
    uint16_t current; /* [step] beside zero, either way, of the latest conversion */
    uint8_t above;    /* conversions in a row above `most` */
    uint8_t unknown;  /* samples in a row without a conversion */
    uint32_t heat;    /* as `budget` */
    uint8_t tripped;  /* guard_verdict of the latest way off */
};

/* The heat where it outlives a reset, which a motor is no colder for: a driver that is started again resets most boards. */
struct guard_memory {
    uint32_t heat, check;
};

/* Takes limits; 0 as `most` watches nothing. */
void guard_set(struct guard *guard, const struct wire_protect *limits);

/* At a sample: whether its current [step at A1], after a period [tick], or that none is converted any more, has to switch
 * the output off. */
enum guard_verdict guard_check(struct guard *guard, uint16_t steps, uint32_t period);

/* Writes the heat down, and reads it after a reset; a memory that holds anything else leaves the guard as it is. */
void guard_keep(const struct guard *guard, struct guard_memory *memory);
void guard_recall(struct guard *guard, const struct guard_memory *memory);

#endif
