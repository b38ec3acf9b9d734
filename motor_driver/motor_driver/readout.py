"""Telemetry frames as samples: voltages, continuous times, and the speed by the rule that all plants share."""

from math import nan

from motor_driver.clock.board_clock import BoardClock
from motor_driver.config import Config
from motor_driver.frames.codes import NOT_MEASURED, Flag
from motor_driver.frames.from_board import Hello, Sensed, Telemetry
from motor_model.gearing.gear import edge_angle
from motor_model.sample import Sample
from motor_model.sensing.speed_rule import SpeedState, single_channel_speed, speed_magnitude
from motor_model.sensing.supply import find_least_supply

HALF, WRAP = 1 << 31, 1 << 32
STEP = 5.0 / 1024  # [V] of the board's converter
MEMORY = 0.5  # [s] over which a measured supply is smoothed: its converter's step is 20 mV
# Of `supply_voltage`, where it is said, and of what the supply was measured as before: no supply at work falls lower,
# and what reads less is a divider that has come loose, or is another one; by as much the motor would get more than was
# asked for. Whatever reads less may be as high as ever, and the motor gets no more than its own voltage of that.
LEAST = 0.5
RISE = 1.05  # times that: more is no noise, and until it is known the motor would get as much more than was asked for


class Readout:
    """Follows one board through wraps and lost frames; a board that starts anew counts edges from 0 again."""

    def __init__(self, config: Config, board: Hello) -> None:
        self._config = config
        self._motor = -1 if config.reverse_motor else 1
        self._encoder = -1 if config.reverse_encoder and not config.single_channel else 1
        self._slot = edge_angle(config.edges_per_revolution, config.gear)
        self.errors = 0  # transitions of both encoder lines at once, over all resets
        self.supply = config.full_voltage  # [V] at full duty
        self.measured = False  # it is that of the board's converter
        self.measures_none = False  # the board has said that it does not measure its supply
        self.highest_supply = 0.0  # [V] that it may have, where what is measured is not to be believed
        self._usual_supply = 0.0  # [V] the most that was measured, smoothed without a jump: a spike is no supply
        self.clock = BoardClock(board.tick_ns)
        self._begin(board)

    def _begin(self, board: Hello) -> None:
        self._errors: int | None
        self._tick, self._top = board.tick_ns, board.pwm_top
        self._count, self._edge_time, self._errors, self._speed_state = 0, 0, None, SpeedState()
        self._recounts = False  # the next sample is the first since a reset

    def restart(self, frame: Telemetry, board: Hello, host: int) -> None:
        """The board has started anew; this is the first that it says, read at `host` [ns]."""
        self.clock.restart(frame.time, host, board.tick_ns)
        self._begin(board)
        self._recounts = True

    def sample(self, frame: Telemetry) -> Sample:
        """The sample in a frame whose time the clock has just heard.

        The first one after a reset says of no edge when it was, whatever has passed since: that is what tells everybody
        that edges are counted from 0 again.
        """
        now = self.clock.newest
        steps = (frame.edge_count - self._count) % WRAP
        self._count += steps - WRAP if steps >= HALF else steps
        self.errors += 0 if self._errors is None else (frame.errors - self._errors) % 256
        self._errors = frame.errors
        if frame.edge_valid:
            self._edge_time = self.clock.before(frame.edge_time)
        self.measures_none = frame.supply == NOT_MEASURED
        self._follow_supply(frame.supply)
        voltage = self._motor * frame.duty / self._top * self.supply
        period = frame.edge_period * self._tick / 1e9
        magnitude = speed_magnitude(self._slot, now, self._edge_time, period, self._config.quadrature)
        told, self._recounts = not self._recounts, False
        return Sample(
            sample_time=now,
            speed=self._speed(frame, magnitude, voltage, now),
            voltage=voltage,
            edge_count=self._encoder * self._count,
            edge_time=self._edge_time if told else 0,
            edge_period=period if told else 0.0,
            current=self._current(frame),
            supply_voltage=nan if frame.supply == NOT_MEASURED else frame.supply * 1e-3,
        )

    def _speed(self, frame: Telemetry, magnitude: float, voltage: float, now: int) -> float:
        if not self._config.single_channel:
            return self._encoder * (-magnitude if frame.flags & Flag.REVERSE else magnitude)
        speed, self._speed_state = single_channel_speed(self._speed_state, magnitude, voltage, now)
        return speed

    def _current(self, frame: Telemetry) -> float:
        """[A] NaN where the board senses none, or nobody said what its sensor makes of one."""
        gain = self._config.current_gain
        if not isinstance(frame, Sensed) or frame.current == NOT_MEASURED or gain == 0.0:
            return nan
        return self._motor * (frame.current * STEP - self._config.current_offset) / gain

    def _follow_supply(self, millivolts: int) -> None:
        """Take the supply that the board measures for the voltage at full duty."""
        if millivolts != NOT_MEASURED and millivolts * 1e-3 >= find_least_supply(self._config.full_voltage):
            share = min(1.0 / (MEMORY * self._config.sample_rate), 1.0)
            self._usual_supply += share * max(millivolts * 1e-3 - self._usual_supply, 0.0)
            usual = max(self._config.supply_voltage, self._usual_supply)
            measured = max(millivolts * 1e-3, LEAST * usual)
            known = self.measured and measured <= RISE * self.supply
            self.supply += (share if known else 1.0) * (measured - self.supply)
            self.measured = True
            self.highest_supply = usual if millivolts * 1e-3 < LEAST * usual else 0.0

    def duty(self, voltage: float) -> int:
        """What to command for a voltage [V]: no more than the motor's, and than the supply gives."""
        limit = min(self._config.max_voltage, self.supply)
        highest = max(self.supply, self.highest_supply)
        most = int(limit / highest * self._top)  # rounded down: half a step more is more than the motor's
        duty = min(max(round(min(max(voltage, -limit), limit) / self.supply * self._top), -most), most)
        return self._motor * duty
