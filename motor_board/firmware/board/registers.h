/* The chip's own timers, pins and interrupts, under names that say what they are for: all that differs from chip to chip
 * is in one of these two files. */
#ifndef REGISTERS_H
#define REGISTERS_H

#if defined(__AVR_ATmega328P__)
#include "registers_atmega328p.h"
#elif defined(__AVR_ATmega2560__)
#include "registers_atmega2560.h"
#else
#error "there is no registers_*.h for this chip"
#endif

#endif
