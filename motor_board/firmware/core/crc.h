/* CRC-32/ISO-HDLC, the one of zlib and Ethernet: reflected, polynomial 0xEDB88320. */
#ifndef CRC_H
#define CRC_H

#include <stdint.h>

uint32_t crc_of(const uint8_t *data, uint8_t size);

#endif
