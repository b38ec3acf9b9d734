/* The encoder's interrupts: its flanks, with their times, go into the device. */
#ifndef ENCODER_H
#define ENCODER_H

#include <stdint.h>

#include "registers.h"

/* Counts as the driver has asked to; from the main loop. */
void encoder_follow(void);

/* Hears edges again, of which there were more than there was time for. */
void encoder_resume(void);

/* Lets so many edges be counted in the next `ticks` as there is time for beside all else: 31,000 a second, and 16 at once.
 * What exceeds them is noise, and is not heard until the next call. With interrupts off, at every compare interrupt. */
static inline void encoder_allow(uint16_t ticks)
{
    if (EDGES_LEFT == 0) {
        encoder_resume();
    }
    EDGES_LEFT = (uint8_t)((ticks >> 8) * 4u + 16u);
}

#endif
