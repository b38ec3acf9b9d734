/* Frames: header, body and CRC, stuffed; see protocol/wire.yaml. */
#ifndef FRAME_H
#define FRAME_H

#include <stdbool.h>
#include <stdint.h>

#include "wire.h"

#define FRAME_HEADER 4u /* byte: version, type, seq */
#define FRAME_CRC 4u

struct frame {
    uint8_t version, type, size; /* size of the body */
    uint16_t seq;
    const uint8_t *body;
};

struct frame_reader {
    uint8_t buffer[WIRE_LONGEST_FRAME];
    uint8_t length; /* bytes gathered; WIRE_LONGEST_FRAME: too many, all dropped up to the next zero */
    bool listening; /* a zero has been seen: what is wrong now is not the end of something older */
    uint16_t bad;   /* frames dropped, wraps */
};

/* Takes one byte of the wire; true if it completes a frame whose CRC is right. `frame` then points into the reader and
 * holds until the next byte. Version, type and size are for the caller to judge. */
bool frame_read(struct frame_reader *reader, uint8_t byte, struct frame *frame);

/* Finishes a frame: data[FRAME_HEADER …] holds `size` bytes of body and has room for FRAME_CRC more. Writes what goes on
 * the wire to `wire` (WIRE_LONGEST_FRAME bytes) and returns its length. */
uint8_t frame_seal(uint8_t *data, uint8_t type, uint16_t seq, uint8_t size, uint8_t *wire);

#endif
