/* The motor's supply voltage through a divider on A0, if config.h says what the divider is. */
#ifndef SUPPLY_H
#define SUPPLY_H

#include <avr/io.h>
#include <stdint.h>
#include <util/atomic.h>

#include "config.h"

#define SUPPLY_A0 _BV(REFS0)                                                 /* against the 5 V supply */
#define SUPPLY_CONVERTER (_BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0)) /* 125 kHz */

static inline void supply_start(void)
{
    if (MOTOR_SUPPLY_FULL_SCALE > 0) {
        ADMUX = SUPPLY_A0;
        ADCSRA = SUPPLY_CONVERTER | _BV(ADSC);
    }
}

/* [mV] of the conversion that is done. */
static inline uint16_t supply_converted(void)
{
    return (uint16_t)((uint32_t)ADC * MOTOR_SUPPLY_FULL_SCALE >> 10);
}

/* Once a conversion is done, takes it [mV] and starts the next. */
static inline void supply_read(uint16_t *millivolts)
{
    if (MOTOR_SUPPLY_FULL_SCALE > 0 && !(ADCSRA & _BV(ADSC))) {
        uint16_t value = supply_converted();
        ATOMIC_BLOCK(ATOMIC_RESTORESTATE) { *millivolts = value; }
        ADCSRA |= _BV(ADSC);
    }
}

#endif
