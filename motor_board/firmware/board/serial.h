/* The serial port, 500 kbaud 8N1, in and out by interrupts. */
#ifndef SERIAL_H
#define SERIAL_H

#include <stdbool.h>
#include <stdint.h>

#include "wire.h"

void serial_start(void);

/* The next byte received; false if there is none. For a zero `time` is when it came [tick]. */
bool serial_read(uint8_t *byte, uint32_t *time);

/* A buffer of WIRE_LONGEST_FRAME bytes to fill while another one is still going out; 0 if there is none. */
uint8_t *serial_buffer(void);

/* Sends what serial_buffer gave, after what is going out. */
void serial_send(uint8_t length);

/* Nothing is going out. */
bool serial_quiet(void);

#endif
