"""The motors of `faults.py`: four top speeds at 12 V, and the paper's scaled to 1.2 and 48 V."""

from dataclasses import dataclass

from motor_model.parameters import PAPER_KA, PAPER_KV, Parameters
from motor_model.sample import Info

TIME_CONSTANT = PAPER_KA / PAPER_KV  # [s] of every motor
SLIDING, BREAKAWAY = 0.033, 0.075  # friction, share of the motor's voltage
KP, KI = 0.2 / PAPER_KV, 2.5 / PAPER_KV  # the controller's defaults, in the motor's own units


@dataclass(frozen=True)
class Motor:
    """A motor by what it does at its full voltage."""

    top: float  # [rad/s] at full voltage, without friction
    voltage: float  # [V]

    @property
    def name(self) -> str:
        """As a heading."""
        return f"{self.top:g} rad/s, {self.voltage:g} V"

    @property
    def kv(self) -> float:
        """[V·s/rad]."""
        return self.voltage / self.top

    def parameters(self, supply: float = 0.0, **more: float) -> Parameters:
        """The motor, with effects that `more` has values for; a supply [V] other than its voltage."""
        values = {
            "kv": self.kv,
            "ka": self.kv * TIME_CONSTANT,
            "ks": SLIDING * self.voltage,
            "breakaway_voltage": BREAKAWAY * self.voltage,
            "stribeck_speed": 0.03 * self.top,
        }
        effects = ("static_friction", *(["load_step"] if "step_voltage" in more else []))
        return Parameters(values | more, effects, supply or self.voltage)

    def settings(self, info: Info, model: bool) -> dict[str, object]:
        """The controller's parameters that fit the motor; with a model, observer and feed-forward."""
        values: dict[str, object] = {"kp": KP * self.kv, "ki": KI * self.kv, "voltage_limit": info.max_voltage}
        return values | ({"speed_source": "observer", "feedforward": True} if model else {})


MOTORS = (
    Motor(6.0, 12.0),
    Motor(30.0, 12.0),
    Motor(174.0, 12.0),
    Motor(600.0, 12.0),
    Motor(174.0, 1.2),
    Motor(174.0, 48.0),
)
