#include "cobs.h"

uint8_t cobs_stuff(const uint8_t *data, uint8_t size, uint8_t *out)
{
    uint8_t *code = out, *at = out + 1;
    for (uint8_t left = size; left; left--) {
        uint8_t byte = *data++;
        if (byte) {
            *at++ = byte;
        } else {
            *code = (uint8_t)(at - code);
            code = at++;
        }
    }
    *code = (uint8_t)(at - code);
    return (uint8_t)(size + 1);
}

uint8_t cobs_unstuff(uint8_t *data, uint8_t size)
{
    if (size < 2) {
        return 0;
    }
    uint8_t next = data[0]; /* where the next code stands */
    for (uint8_t at = 1; at < size; at++) {
        uint8_t byte = data[at];
        if (byte == 0 || next == 0) {
            return 0;
        }
        if (at == next) {
            next = (uint8_t)(at + byte); /* one that wraps lies behind, and never becomes `size` */
            byte = 0;
        }
        data[at - 1] = byte;
    }
    return next == size ? (uint8_t)(size - 1) : 0;
}
