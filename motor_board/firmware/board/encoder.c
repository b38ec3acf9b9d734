#include "encoder.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#include "board.h"
#include "clock.h"
#include "config.h"
#include "lines.h"
#include "quadrature.h"
#include "registers.h"

#if MOTOR_CHANNELS == 2
/* The capture unit is set to A's next flank. One that came before that has the time of its being noticed. */
static inline void see_a(uint16_t counter)
{
    for (;;) {
        uint8_t lines = lines_read();
        quadrature_see_a(&board_device.edges, counter, clock_overflow_pending(), lines);
        clock_capture(!(lines & QUADRATURE_A));
        if (!((lines_read() ^ lines) & QUADRATURE_A)) {
            return;
        }
        counter = CLOCK_COUNTER;
    }
}

static inline void see_fall(void)
{
    if (!lines_a_is_high()) {
        uint16_t counter = CLOCK_COUNTER;
        device_fall(&board_device, counter, clock_overflow_pending(), lines_b_is_high());
    }
}
#endif

void encoder_follow(void)
{
#if MOTOR_CHANNELS == 2
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        uint8_t fold = board_device.quadrature, lines = lines_read();
        if (fold != board_device.edges.fold) {
            quadrature_start(&board_device.edges, fold, lines);
            lines_interrupt(fold);
            clock_capture(fold == 1 || !(lines & QUADRATURE_A));
        }
    }
#endif
}

ISR(CLOCK_CAPTURE_vect)
{
    uint16_t counter = CLOCK_CAPTURED;
#if MOTOR_CHANNELS == 1
    device_capture(&board_device, counter, clock_overflow_pending());
#else
    if (board_device.edges.fold > 1) {
        see_a(counter);
        return;
    }
    device_rise(&board_device, counter, clock_overflow_pending(), lines_b_is_high());
    see_fall(); /* a pulse that is over already: its interrupt came before this one, and knew of no rising edge */
#endif
}

#if MOTOR_CHANNELS == 2
/* A has changed; its rising edges are captured. */
ISR(LINES_A_vect)
{
    see_fall();
}

/* B has changed. */
ISR(LINES_B_vect)
{
    uint16_t counter = CLOCK_COUNTER;
    bool pending = clock_overflow_pending();
    uint8_t lines = lines_read();
    quadrature_see_b(&board_device.edges, counter, pending, lines, CHIP_B_LATE);
    if (!((board_device.edges.lines ^ lines) & QUADRATURE_A)) { /* also after an error: A's flank has been noted */
        clock_capture(!(lines & QUADRATURE_A));
    }
}
#endif
