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

/* For each edge first: the last one for which there is time switches their interrupts off. Ticks, bytes and the counter's
 * overflows come after edges, and whoever holds them up holds up what switches the motor off. */
static inline void count_interrupt(void)
{
    if (--EDGES_LEFT == 0) {
        CLOCK_INTERRUPTS &= (uint8_t)~CLOCK_EDGES;
#if MOTOR_CHANNELS == 2
        LINES_INTERRUPTS = 0;
#endif
    }
}

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
        count_interrupt();
        if (EDGES_LEFT == 0) {
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

#if MOTOR_CHANNELS == 2
static void begin(uint8_t fold)
{
    uint8_t lines = lines_read();
    quadrature_start(&board_device.edges, fold, lines);
    lines_interrupt(fold);
    clock_capture(fold == 1 || !(lines & QUADRATURE_A));
}
#endif

void encoder_follow(void)
{
#if MOTOR_CHANNELS == 2
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        if (board_device.quadrature != board_device.edges.fold) {
            begin(board_device.quadrature);
        }
    }
#endif
}

void encoder_resume(void)
{
    board_device.edges.known = 0; /* no period reaches across */
#if MOTOR_CHANNELS == 2
    board_device.edges.errors++;
    begin(board_device.edges.fold);
    LINES_FLAGS = LINES_DUE;
#endif
    CLOCK_FLAGS = CLOCK_EDGE_DUE; /* of an edge long ago; the others are cleared by a 1 only */
    CLOCK_INTERRUPTS |= CLOCK_EDGES;
}

ISR(CLOCK_CAPTURE_vect)
{
    uint16_t counter = CLOCK_CAPTURED;
    count_interrupt();
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
    count_interrupt();
    see_fall();
}

/* B has changed. */
ISR(LINES_B_vect)
{
    uint16_t counter = CLOCK_COUNTER;
    bool pending = clock_overflow_pending();
    count_interrupt();
    uint8_t lines = lines_read();
    quadrature_see_b(&board_device.edges, counter, pending, lines, CHIP_B_LATE);
    if (!((board_device.edges.lines ^ lines) & QUADRATURE_A)) { /* also after an error: A's flank has been noted */
        clock_capture(!(lines & QUADRATURE_A));
    }
}
#endif
