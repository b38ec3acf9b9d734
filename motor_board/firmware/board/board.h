/* What interrupts and the main loop share. */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stdint.h>

#include "device.h"

extern struct device board_device; /* with interrupts off, but for what only one of them uses */
extern volatile bool board_woken;  /* an interrupt has left the main loop something to do */

/* [tick] now; with interrupts off. */
uint32_t board_now(void);

#endif
