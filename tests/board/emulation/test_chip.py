"""The emulated chip: what runs on it."""

import subprocess
from pathlib import Path

import pytest
from emulated_board import MS, need_emulator, on_each_chip

from motor_board.emulation.chip import Chip
from motor_board.errors import BoardError


def test_a_file_that_is_no_program_is_refused(tmp_path: Path) -> None:
    need_emulator()
    (tmp_path / "text.elf").write_text("no program")
    for name in ("text.elf", "missing.elf"):
        with pytest.raises(BoardError, match=f"{name} is no program for an ATmega328P or ATmega2560: build it again"):
            Chip(tmp_path / name)


LATE = """
#include <avr/interrupt.h>
#include <avr/io.h>
#ifdef __AVR_ATmega2560__
#define CLOCK(register) register(5)
#define PIN DDRE, PORTE, 5
#else
#define CLOCK(register) register(1)
#define PIN DDRD, PORTD, 3
#endif
#define COUNTER_(n) TCNT##n
#define COMPARE_(n) OCR##n##A
#define CONTROL_(n) TCCR##n##B
#define CHOSEN_(n) TIMSK##n
#define VECTOR_(n) TIMER##n##_COMPA_vect
#define COUNTER CLOCK(COUNTER_)
#define COMPARE CLOCK(COMPARE_)
#define CONTROL CLOCK(CONTROL_)
#define CHOSEN CLOCK(CHOSEN_)
#define HIGH_(ddr, port, bit) (ddr |= 1 << bit, port |= 1 << bit)
#define HIGH(pin) HIGH_(pin)

ISR(CLOCK(VECTOR_))
{
    HIGH(PIN);
}

int main(void)
{
    COMPARE = 1000;
    CONTROL = 1;
    sei();
    while (COUNTER < 2000) {
    }
    CHOSEN |= 2;
    for (;;) {
    }
}
"""


@on_each_chip
def test_a_flag_that_rose_while_its_interrupt_was_off_interrupts_when_it_is_let_on(tmp_path: Path, chip: str) -> None:
    """As the data sheet has it; it waited for the counter's next turn, 65,536 cycles."""
    need_emulator()
    (tmp_path / "late.c").write_text(LATE, encoding="utf-8")
    words = ["avr-gcc", f"-mmcu={chip}", "-Os", "-o", str(tmp_path / "late.elf"), str(tmp_path / "late.c")]
    subprocess.run(words, check=True, timeout=60.0)
    board = Chip(tmp_path / "late.elf")
    while board.cycle < 8 * MS and board.pins.enable == 0:
        board.run(board.cycle + 100)
    risen = board.cycle
    board.close()
    assert 2000 < risen < 3000
