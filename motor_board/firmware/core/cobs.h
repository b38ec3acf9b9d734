/* COBS framing (Cheshire & Baker 1999) for blocks of up to 253 bytes: no zero inside, so that a zero ends a frame. */
#ifndef COBS_H
#define COBS_H

#include <stdint.h>

/* Writes size + 1 bytes to out, which may not overlap data; returns size + 1. */
uint8_t cobs_stuff(const uint8_t *data, uint8_t size, uint8_t *out);

/* Undoes it in place; returns the size of the result, 0 if `data` was not a result of cobs_stuff (or was empty). */
uint8_t cobs_unstuff(uint8_t *data, uint8_t size);

#endif
