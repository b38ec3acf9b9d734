/* The encoder's interrupts: its flanks, with their times, go into the device. */
#ifndef ENCODER_H
#define ENCODER_H

/* Counts as the driver has asked to; from the main loop. */
void encoder_follow(void);

#endif
