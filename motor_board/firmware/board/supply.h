/* The motor's supply voltage through a divider on A0, if config.h says what the divider is. */
#ifndef SUPPLY_H
#define SUPPLY_H

#include <avr/io.h>
#include <stdint.h>
#include <util/atomic.h>

#include "config.h"

static inline void supply_start(void)
{
    if (MOTOR_SUPPLY_FULL_SCALE > 0) {
        ADMUX = _BV(REFS0);                                          /* against the 5 V supply, channel A0 */
        ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0) | _BV(ADSC); /* 125 kHz */
    }
}

/* Once a conversion is done, takes it [mV] and starts the next. */
static inline void supply_read(uint16_t *millivolts)
{
    if (MOTOR_SUPPLY_FULL_SCALE > 0 && !(ADCSRA & _BV(ADSC))) {
        uint16_t value = (uint16_t)((uint32_t)ADC * MOTOR_SUPPLY_FULL_SCALE >> 10);
        ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { *millivolts = value; }
        ADCSRA |= _BV(ADSC);
    }
}

#endif
