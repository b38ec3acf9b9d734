/* The sample tick: a compare interrupt that moves the output, then takes the sample. */
#ifndef TICK_H
#define TICK_H

/* Starts the clock, and with it the ticks. */
void tick_start(void);

/* Holds off the watchdog while both the tick and the main loop, which calls this, live. */
void tick_feed_watchdog(void);

#endif
