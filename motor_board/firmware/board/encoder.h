/* The encoder's interrupts: its flanks, with their times, go into the device. */
#ifndef ENCODER_H
#define ENCODER_H

#include <stdbool.h>
#include <stdint.h>

/* Counts as the driver has asked to; from the main loop. */
void encoder_follow(void);

/* Lets so many interrupts of edges come in the next `ticks` as there is time for beside all else: 50,000 a second at 1 kHz
 * and 51,000 at 200 Hz (two channels: 43,000 at 1 kHz, twofold 33,000). What exceeds them is not heard until
 * the next call, which tells of it as an error; fewer are let come after that, and few if the main loop has been starving:
 * noise has no least distance, and a byte in every pause. With interrupts off, at every compare interrupt. */
void encoder_allow(uint16_t ticks, bool starving);

#endif
