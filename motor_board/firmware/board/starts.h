/* How often the board has started, over all power-downs. */
#ifndef STARTS_H
#define STARTS_H

#include <stdint.h>

/* Counts one start, and returns the count; it wraps. */
uint8_t starts_next(void);

#endif
