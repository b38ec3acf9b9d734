"""What can be wrong with a new board: a name, what is so, what to do about it, and what software can do instead."""

from dataclasses import dataclass, field

REVERSE_MOTOR, REVERSE_ENCODER = "reverse_motor", "reverse_encoder"  # parameters of the driver


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong."""

    code: str
    sentence: str
    cure: str
    parameters: dict[str, bool] = field(default_factory=dict)  # of the driver, with which it is right as it is wired

    @property
    def cured(self) -> bool:
        """Whether the parameter file makes up for it."""
        return bool(self.parameters)


# code: (what is so, what to do, the driver's parameters that make up for it)
TABLE: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "no_supply": (
        "The motor has no supply: {supply:.1f} V are measured, {expected:.3g} V are expected.",
        "Switch the supply on; join its ground to the board's.",
        (),
    ),
    "supply_too_low": (
        "The supply is too low: {supply:.1f} V are measured, {expected:.3g} V are expected.",
        "Use the right supply, or say --supply-voltage {supply:.3g}.",
        (),
    ),
    "supply_too_high": (
        "The supply is too high: {supply:.1f} V are measured, {expected:.3g} V are expected.",
        "Use the right supply; if it is meant to be, say --supply-voltage {supply:.3g} (the motor still gets no more "
        "than --max-voltage).",
        (),
    ),
    "bridge_stuck_on": (
        "The motor turns although the board gives 0 V ({rate:.0f} edges a second): the bridge is stuck on.",
        "Switch the motor's supply off. D3 has to be wired to the bridge's enable, with that one's jumper taken off, "
        "and pulled down by 10 kΩ; D5 and D6 to its inputs; or the bridge is broken.",
        (),
    ),
    "hum": (
        "Edges come at {rate:.4g} Hz with the motor off and the shaft at rest: the mains' hum on an encoder line that "
        "nothing holds.",
        "Give the line a pull-up (4.7 kΩ to 5 V), join the encoder's ground, and keep its cable away from the mains.",
        (),
    ),
    "noise": (
        "{rate:.0f} edges a second come with the motor off and the shaft at rest.",
        "See the encoder's supply and ground, and its line's pull-up (4.7 kΩ to 5 V); keep its cable away from others.",
        (),
    ),
    "edges_at_rest": (
        "Edges come at {rate:.4g} Hz with the motor off, as even as a motor that turns and as the mains' hum.",
        "Look at the shaft. If it turns, the bridge is stuck on: switch the supply off, see D3, D5 and D6. If it does "
        "not, the encoder's line lacks a pull-up (4.7 kΩ to 5 V) or its ground.",
        (),
    ),
    "nobody_answered": (
        "Nobody has said that the turn by hand is done: a hand may be on the shaft, and the motor is not driven.",
        "Run it again and press Enter after the turn; where nobody is there, say --no-hand.",
        (),
    ),
    "a_missing": (
        "The shaft was turned by hand, and no edge came: channel A does not reach D8.",
        "See the encoder's signal A on D8, its supply and its ground.",
        (),
    ),
    "b_missing": (
        "Channel A's edges come, and channel B never changes: it does not reach D7.",
        "See the encoder's signal B on D7; with one channel only, flash with --channels 1.",
        (),
    ),
    "wrong_counts": (
        "{turns} by hand gave {counted:d} edges, where {expected:.0f} are expected.",
        "{hint}",
        (),
    ),
    "unknown_counts": (
        "{turns} by hand gave {counted:d} edges, and nobody has said how many a turn has.",
        "Say --edges-per-revolution: edges of one polarity of one channel, in one turn of the encoder's shaft.",
        (),
    ),
    "no_counts": (
        "Nobody has said how many edges a turn has.",
        "Say --edges-per-revolution: edges of one polarity of one channel, in one turn of the encoder's shaft.",
        (),
    ),
    "channels_swapped": (
        "Turned forward by hand, the encoder counts backward: its channels A and B are exchanged.",
        "Exchange the wires on D7 and D8, or keep reverse_encoder: true.",
        (REVERSE_ENCODER,),
    ),
    "motor_swapped": (
        "A positive voltage turns the motor backward: its two wires are exchanged.",
        "Exchange the motor's two wires, or keep reverse_motor: true.",
        (REVERSE_MOTOR,),
    ),
    "against": (
        "The encoder counts backward at a positive voltage: the motor's wires are exchanged, or channels A and B.",
        "Without a hand on the shaft nobody can tell which. If the motor turns the wrong way, exchange its two wires; "
        "if not, D7 and D8; or keep reverse_encoder: true.",
        (REVERSE_ENCODER,),
    ),
    "stuck_shaft": (
        "The shaft cannot be turned by hand, and {highest:.3g} V (half of the motor's) do not turn it: it is stuck.",
        "Free the shaft. If it is free and only the gears are stiff, see the bridge's outputs and the motor's wires.",
        (),
    ),
    "no_power": (
        "The shaft is free and the encoder counts, and {highest:.3g} V (half of the motor's) do not turn the motor.",
        "See the motor's supply and its ground, D3, D5 and D6 to the bridge, a TB6612's STBY, and the motor's wires.",
        (),
    ),
    "no_motion": (
        "No edge came up to {highest:.3g} V (half of the motor's).",
        "One of these: no supply at the bridge, the bridge's or the motor's wires, a shaft that is stuck, or no "
        "encoder on D8. Without a hand on the shaft nobody can tell which: leave --no-hand out.",
        (),
    ),
    "one_way": (
        "The motor turns at {way} voltages only.",
        "See D5 and D6 to the bridge's two inputs: one of them is off, or the bridge is broken.",
        (),
    ),
    "same_way": (
        "The motor turns the same way at positive and at negative voltages.",
        "See D5 and D6 to the bridge's two inputs.",
        (),
    ),
    "not_proportional": (
        "The speed does not follow the voltage: {low:.3g} V give {low_rate:.0f} edges a second, {high:.3g} V "
        "{high_rate:.0f}.",
        "See D3 to the bridge's enable, with that one's jumper taken off.",
        (),
    ),
    "too_many_edges": (
        "At {voltage:.3g} V the encoder makes {rate:.0f} edges a second, and the board counts {most:.0f} for certain.",
        "Lower --max-voltage, or take an encoder with fewer edges.",
        (),
    ),
    "stopped": ("The check has stopped the motor: {why}.", "Mend that, and check again.", ()),
}


def finding(code: str, **values: object) -> Finding:
    """Return the row of the table, with its numbers."""
    sentence, cure, parameters = TABLE[code]
    return Finding(code, sentence.format(**values), cure.format(**values), dict.fromkeys(parameters, True))
