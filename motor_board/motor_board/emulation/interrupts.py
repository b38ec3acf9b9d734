"""What the firmware's interrupts are for, by their number on each chip, and what each has cost."""

from dataclasses import dataclass

VECTORS = {  # what the program's interrupts are for, by their number
    "atmega328p": {
        3: "change",
        5: "channel B",
        10: "capture",
        11: "compare",
        13: "overflow",
        18: "receive",
        19: "transmit",
    },
    "atmega2560": {
        4: "change",
        3: "channel B",
        46: "capture",
        47: "compare",
        50: "overflow",
        25: "receive",
        26: "transmit",
    },
}
MOST_VECTORS = 64


@dataclass(frozen=True, slots=True)
class InterruptLoad:
    """What one interrupt has cost."""

    calls: int
    cycles: int  # without nested interrupts
    longest: int  # [cycle] likewise
    waited: int  # [cycle] the longest that one had to wait for its turn
