#include "frame.h"

#include "cobs.h"
#include "crc.h"

static bool frame_close(struct frame_reader *reader, struct frame *frame)
{
    uint8_t *data = reader->buffer;
    uint8_t size = reader->length < WIRE_LONGEST_FRAME ? cobs_unstuff(data, reader->length) : 0;
    if (size < FRAME_HEADER + FRAME_CRC) {
        return false;
    }
    size = (uint8_t)(size - FRAME_CRC);
    if (crc_of(data, size) != wire_get_u32(data + size)) {
        return false;
    }
    frame->version = data[0];
    frame->type = data[1];
    frame->seq = wire_get_u16(data + 2);
    frame->body = data + FRAME_HEADER;
    frame->size = (uint8_t)(size - FRAME_HEADER);
    return true;
}

bool frame_read(struct frame_reader *reader, uint8_t byte, struct frame *frame)
{
    if (byte != 0) {
        if (reader->length < WIRE_LONGEST_FRAME) {
            reader->buffer[reader->length++] = byte;
        }
        return false;
    }
    bool good = frame_close(reader, frame);
    if (!good && reader->listening && reader->length > 0) {
        reader->bad++;
    }
    reader->length = 0;
    reader->listening = true;
    return good;
}

uint8_t frame_seal(uint8_t *data, uint8_t type, uint16_t seq, uint8_t size, uint8_t *wire)
{
    wire_put_u16(wire_put_u8(wire_put_u8(data, WIRE_VERSION), type), seq);
    size = (uint8_t)(size + FRAME_HEADER);
    wire_put_u32(data + size, crc_of(data, size));
    uint8_t length = cobs_stuff(data, (uint8_t)(size + FRAME_CRC), wire);
    wire[length] = 0;
    return (uint8_t)(length + 1);
}
