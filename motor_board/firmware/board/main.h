/* What interrupts in other files need of the main loop. */
#ifndef MAIN_H
#define MAIN_H

#include <stdbool.h>
#include <stdint.h>

extern volatile bool main_woken; /* an interrupt has left something to do */

/* [tick] now; with interrupts off. */
uint32_t main_now(void);

#endif
