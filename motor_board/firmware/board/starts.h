/* How often the board has started, over all power-downs. */
#ifndef STARTS_H
#define STARTS_H

#include <stdint.h>

/* Counts one start, and returns a number that no other of 65,536 starts has. */
uint16_t starts_next(void);

#endif
