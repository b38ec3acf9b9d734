#include "bridge.h"

#include <avr/io.h>
#include <stdbool.h>

#include "config.h"
#include "wire.h"

#define ENABLE _BV(PD3)  /* D3, OC2B */
#define FORWARD _BV(PD5) /* D5, OC0B */
#define REVERSE _BV(PD6) /* D6, OC0A */
#define INPUTS (FORWARD | REVERSE)

#define FAST_PWM_0 (_BV(WGM01) | _BV(WGM00)) /* mode 3: 0 … 255 */
#define FAST_PWM_2 (_BV(WGM21) | _BV(WGM20))
#define CLOCK_0 _BV(CS01) /* 2 MHz: PWM at 7.8 kHz, which an L298N follows */
#define CLOCK_2 _BV(CS21)

/* In the off part of a period the bridge has its enable low, or both inputs low; which of the two brakes is the bridge's. */
#if MOTOR_BRIDGE == BRIDGE_L298N
#define DECAY_OF_ENABLE WIRE_DECAY_COAST
#elif MOTOR_BRIDGE == BRIDGE_TB6612
#define DECAY_OF_ENABLE WIRE_DECAY_BRAKE
#else
#error "MOTOR_BRIDGE in config.h is neither BRIDGE_L298N nor BRIDGE_TB6612"
#endif

static bool backward;

void bridge_start(void)
{
    PORTD &= (uint8_t)~(ENABLE | INPUTS);
    DDRD |= ENABLE | INPUTS;
    TCCR0A = FAST_PWM_0;
    TCCR2A = FAST_PWM_2;
    TCCR2B = CLOCK_2;
}

/* PWM on the enable, inputs say the direction. A compare value of n - 1 is high for n of 256 counts; as 0 is high for
 * one, duty 0 is a plain low pin. `anew`: the pin was low or meant something else. The chip takes a compare value over
 * when the next period begins, and until then would pulse with an old one: a count of 255 makes one begin now. */
static void write_enable(uint8_t compare, bool zero, bool anew)
{
    TCCR0A = FAST_PWM_0;
    TCCR0B = 0;
    if (zero || anew) {
        TCCR2A = FAST_PWM_2;
    }
    PORTD = (uint8_t)((PORTD & ~(ENABLE | INPUTS)) | (backward ? REVERSE : FORWARD));
    if (!zero) {
        OCR2B = compare;
        if (anew) {
            TCNT2 = 0xFF;
        }
        TCCR2A = FAST_PWM_2 | _BV(COM2B1);
    }
}

/* PWM on one input, the other one low, the enable high throughout. */
static void write_input(uint8_t compare, bool zero, bool anew)
{
    TCCR2A = FAST_PWM_2;
    if (zero || anew) {
        TCCR0A = FAST_PWM_0;
        TCCR0B = 0;
    }
    PORTD = (uint8_t)((PORTD & ~INPUTS) | ENABLE);
    if (!zero) {
        if (backward) {
            OCR0A = compare;
        } else {
            OCR0B = compare;
        }
        if (anew) {
            TCNT0 = 0xFF;
        }
        TCCR0A = FAST_PWM_0 | (backward ? _BV(COM0A1) : _BV(COM0B1));
        TCCR0B = CLOCK_0;
    }
}

void bridge_write(int16_t duty, uint8_t decay)
{
    static int16_t before;
    static uint8_t decay_before = 0xFF;
    if (duty == before && decay == decay_before) {
        return;
    }
    bool anew = before == 0 || (duty < 0) != backward || decay != decay_before;
    if (duty != 0) {
        backward = duty < 0;
    }
    before = duty;
    decay_before = decay;
    uint8_t compare = (uint8_t)((duty < 0 ? -duty : duty) - 1);
    if (decay == DECAY_OF_ENABLE) {
        write_enable(compare, duty == 0, anew);
    } else {
        write_input(compare, duty == 0, anew);
    }
}
