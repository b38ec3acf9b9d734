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

#define EDGES_RATE (MOTOR_CHANNELS == 2 ? 8u : 9u) /* in 256 ticks */
#define EDGES_FEWER (MOTOR_CHANNELS == 2 ? 16u : 14u) /* bytes, a sample and frames take as long */
#define EDGES_TWOFOLD 10u /* likewise: both flanks of A take longer than one of each line */
#define EDGES_LEAST 8u
#define EDGES_DISTRUST 8u /* compare interrupts */

/* For each edge first: the last one for which there is time switches their interrupts off. Ticks, bytes and the counter's
 * overflows come after edges, and whoever holds them up holds up what switches the motor off. */
static inline void count_interrupt(void)
{
    if (--EDGES_LEFT == 0) { /* whose interrupts come is not 0 */
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
        if (EDGES_LEFT == 0) {
            return;
        }
        count_interrupt();
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
    if (CLOCK_INTERRUPTS & CLOCK_EDGES) { /* else resume does that */
        lines_interrupt(fold);
    }
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

#if MOTOR_CHANNELS == 2
/* Begins with the lines as they are; whether they, or their interrupts' flags, tell of what was not heard. */
static inline bool resume_lines(struct edge_timer *edges)
{
    uint8_t lines = lines_read();
    bool missed = (LINES_FLAGS & lines_watched(edges->fold)) || (edges->fold > 1 && lines != edges->lines);
    edges->lines = lines;
    clock_capture(edges->fold == 1 || !(lines & QUADRATURE_A));
    LINES_FLAGS = LINES_DUE;
    lines_interrupt(edges->fold);
    return missed;
}
#endif

/* Hears edges again, of which there were more than there was time for; whether any were missed. */
static bool __attribute__((noinline)) resume(void)
{
    struct edge_timer *edges = &board_device.edges;
    bool missed = CLOCK_FLAGS & CLOCK_EDGE_DUE;
    EDGE_STALE = missed; /* its interrupt comes yet; its flag is not cleared here, as others are beside it */
    if (missed) { /* the capture unit has gone on, and has the time of the latest */
        uint32_t now = board_now();
        edge_timer_move(edges, now - (uint16_t)((uint16_t)now - CLOCK_CAPTURED));
    }
#if MOTOR_CHANNELS == 2
    missed |= resume_lines(edges);
#endif
    edges->inside = edges->inside && !missed;
    edges->errors = (uint8_t)(edges->errors + missed);
    CLOCK_INTERRUPTS |= CLOCK_EDGES;
    return missed;
}

static uint8_t most_edges(uint16_t ticks)
{
    uint8_t fewer = MOTOR_CHANNELS == 2 && board_device.edges.fold == 2 ? EDGES_FEWER + EDGES_TWOFOLD : EDGES_FEWER;
    uint16_t edges = (uint16_t)((uint8_t)(ticks >> 7) * EDGES_RATE) >> 1;
    return edges > UINT8_MAX ? UINT8_MAX : edges > fewer + EDGES_LEAST ? (uint8_t)(edges - fewer) : EDGES_LEAST;
}

void encoder_allow(uint16_t ticks, bool starving)
{
    static uint8_t distrusted;
    if (CLOCK_INTERRUPTS & CLOCK_EDGES) {
        distrusted = (uint8_t)(distrusted - (distrusted > 0));
    } else if (resume()) {
        distrusted = distrusted > 0 ? (uint8_t)(distrusted - 1u) : EDGES_DISTRUST;
    }
    EDGES_LEFT = starving ? EDGES_LEAST : distrusted > 0 ? (uint8_t)((ticks >> 8) * 3u + EDGES_LEAST) : most_edges(ticks);
}

ISR(CLOCK_CAPTURE_vect)
{
    uint16_t counter = CLOCK_CAPTURED;
    count_interrupt();
#if MOTOR_CHANNELS == 2
    if (board_device.edges.fold > 1) {
        see_a(counter);
        return;
    }
#endif
    if (EDGE_STALE) {
        EDGE_STALE = false;
        return;
    }
#if MOTOR_CHANNELS == 1
    device_capture(&board_device, counter, clock_overflow_pending());
#else
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
