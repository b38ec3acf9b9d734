"""The driver's state as a diagnostic: one sentence on what is wrong and how to mend it, and the link's numbers."""

from dataclasses import dataclass

from motor_driver.config import Config
from motor_driver.driver import DEAF, Driver
from motor_driver.exchange import Exchange
from motor_driver.frames.from_board import Hello
from motor_driver.protocol import LinkCounters
from motor_driver.readout import LEAST

LEAST_RATE = 0.95  # of the requested one
OTHER_SUPPLY = 0.1  # of supply_voltage: more than a divider's two resistors of 5 % are off
DEFAULT_VOLTAGE = Config().max_voltage  # [V] of whoever said nothing of the motor
ASSUMED = (
    "Full duty is taken for the {0:g} V of max_voltage: the board measures no supply, and supply_voltage is not set. "
    "On a larger supply the motor gets more than is asked for, and more than max_voltage: set supply_voltage to the "
    "supply's voltage ({0:g} if that is it)."
)

LOW = 0.5  # of max_voltage: who says less of a supply has most often misplaced a decimal point
TOO_LOW = (
    "supply_voltage is {0:g} V, less than half of the {1:g} V of max_voltage, and the board measures no supply: where "
    "there is more, the motor gets so many times what is asked for. Set supply_voltage to the supply's voltage, or "
    "max_voltage to {0:g} if that is it."
)


@dataclass(frozen=True, slots=True)
class Tally:
    """What had been counted at some time."""

    at: int = 0  # [ns]
    readings: int = 0
    link: LinkCounters = LinkCounters()
    runs: bool = False
    openings: int = 0
    encoder_errors: int = 0


def tally(driver: Driver, now: int) -> Tally:
    """Return what has been counted by now [ns]."""
    return Tally(now, driver.readings, driver.counters, driver.runs, driver.openings, driver.encoder_errors)


def problem(driver: Driver, was: Tally, now: int) -> str:
    """Return what is wrong, the most important first; empty if nothing is."""
    session, rate = driver.session, achieved(driver, was, now)
    if session is None:
        return driver.trouble
    steady = was.runs and driver.runs and was.openings == driver.openings
    sentences = (
        session.handshake.problem(now),
        f"No telemetry comes from {session.port}: see its cable, or reset the board." if session.silent else "",
        capital(DEAF.format(session.port)) if driver.runs and session.exchange and session.exchange.deaf else "",
        capital(driver.motion.finding),
        _supply(driver),
        f"Only {rate:.0f} samples per second come instead of {driver.config.sample_rate:.0f}: close other programs, or "
        "lower sample_rate."
        if steady and rate < LEAST_RATE * driver.config.sample_rate
        else "",
        _encoder(driver.encoder_errors - was.encoder_errors, driver.board),
        _noise(driver.counters, was.link),
    )
    return next(filter(None, sentences), "")


def connection(driver: Driver) -> str:
    """Return what has just begun to run, as a sentence."""
    board, config = driver.board, driver.config
    if driver.session is None or board is None:
        return ""
    number = f", board_id {board.board_id}" if board.board_id else ""
    return (
        f"Connected to {driver.session.port}: firmware {board.firmware}{number}, {config.edges_per_revolution} edges "
        f"per revolution, {driver.info.max_voltage:g} V."
    )


def assumption(driver: Driver) -> str:
    """Say that the supply is only assumed, where max_voltage was set to another value, or is said to be so low that it
    is hardly meant; empty where it is known.
    """
    if too_low := _too_low(driver):
        return too_low
    assumed = driver.assumed_supply
    return ASSUMED.format(assumed) if assumed not in (0.0, DEFAULT_VOLTAGE) else ""


def risk(driver: Driver) -> str:
    """Return that assumption where max_voltage was lowered, or the supply: whoever did so to be careful is not."""
    return assumption(driver) if driver.assumed_supply < DEFAULT_VOLTAGE else ""


def _too_low(driver: Driver) -> str:
    told, most = driver.config.supply_voltage, driver.config.max_voltage
    return TOO_LOW.format(told, most) if driver.measures_none and 0.0 < told < LOW * most else ""


def values(driver: Driver, was: Tally, now: int) -> dict[str, str]:
    """Return the link's numbers by name and unit."""
    session, counters = driver.session, driver.counters
    rows = {
        "port": session.port if session else "none",
        "output": session.switch.output.name.lower().replace("_", " ") if session else "off",
        "good frames": counters.good,
        "CRC errors": counters.bad,
        "lost frames": counters.lost,
        "achieved rate [Hz]": f"{achieved(driver, was, now):.1f}",
        "requested rate [Hz]": f"{driver.config.sample_rate:.1f}",
        "voltage at full duty [V]": f"{driver.supply:.2f}",
        "voltage at full duty from": _source(driver),
        "ports opened": driver.openings,
        "board resets": driver.resets,
        "encoder errors": driver.encoder_errors,
        **_board(driver.board),
        **_clock(session.exchange if session else None),
    }
    return {key: str(value) for key, value in rows.items()}


def achieved(driver: Driver, was: Tally, now: int) -> float:
    """[Hz] samples per second since `was`."""
    return (driver.readings - was.readings) / max((now - was.at) * 1e-9, 1e-9)


def _noise(counters: LinkCounters, was: LinkCounters) -> str:
    bad, lost = counters.bad - was.bad, counters.lost - was.lost
    if not bad and not lost:
        return ""
    return f"{bad} damaged and {lost} lost frames in the last second: see cable, ground and the machine's load."


def _encoder(errors: int, board: Hello | None) -> str:
    """Transitions that no motion makes, and edges that the board had no time for."""
    if errors <= 0 or board is None:
        return ""
    if board.channels == 1:
        return (
            f"More edges than the board can count came {errors} times in the last second, and counts are lost: see the "
            "encoder's cable and supply for noise, or take an encoder with fewer edges."
        )
    return (
        f"Both encoder lines changed at once, or too fast, {errors} times in the last second, and the counts there are "
        "lost: see the encoder's cable and supply, or count less with quadrature 2."
    )


def _source(driver: Driver) -> str:
    """Where the voltage at full duty comes from."""
    if driver.measures_supply:
        return "the board's measurement"
    return "supply_voltage" if driver.config.supply_voltage else "max_voltage, as nobody says or measures the supply"


def _supply(driver: Driver) -> str:
    """A measured supply that is not what the parameter says."""
    told, taken, highest = driver.config.supply_voltage, driver.supply, driver.highest_supply
    if highest > told:
        return (
            f"The board measures a supply of less than {LEAST * highest:.1f} V, and it was {highest:.1f} V: the former "
            "are taken for it. See whether the divider at A0 is connected; if the supply is another one, start the "
            "driver again."
        )
    if not told or abs(taken - told) <= OTHER_SUPPLY * told:
        return ""
    if taken <= 1.01 * LEAST * told:
        return (
            f"The board measures a supply of {taken:.1f} V or less, and supply_voltage is {told:g} V: {taken:.1f} V "
            "are taken for it. See whether the divider at A0 is connected, or set supply_voltage."
        )
    return f"The board measures a supply of {taken:.1f} V, and supply_voltage is {told:g} V: the measured one is used."


def capital(sentence: str) -> str:
    """Return a clause as a sentence."""
    return f"{sentence[0].upper()}{sentence[1:]}." if sentence else ""


def _board(board: Hello | None) -> dict[str, object]:
    if board is None:
        return {}
    return {"firmware": board.firmware, "board id": board.board_id}


def _clock(exchange: Exchange | None) -> dict[str, object]:
    if exchange is None or exchange.fit.fit is None or exchange.round_trip is None:
        return {}
    fit = exchange.fit.fit
    return {
        "frames damaged on the way to the board": exchange.board.bad_frames,
        "samples the board could not send": exchange.board.dropped_samples,
        "clock drift [ppm]": f"{-fit.drift * 1e6:.1f}",
        "clock uncertainty [ms]": f"{fit.bound * 1e-6:.3f}",
        "round trip [ms]": f"{exchange.round_trip * 1e-6:.2f}",
    }
