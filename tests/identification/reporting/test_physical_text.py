"""Physical quantities as a person reads them."""

from math import nan

from motor_identification.reporting.physical_text import format_physical, list_physical_notes
from motor_model.physical.result import PhysicalResult


def test_values_to_their_errors_in_spoken_units() -> None:
    values = {"resistance": 2.30012, "inductance": nan, "torque_constant": 0.065, "inertia": 1.4e-4}
    values |= {"viscous_friction": 1e-7, "friction_torque": 0.01}
    errors = {"resistance": 0.0011, "inductance": nan, "torque_constant": nan, "inertia": 2e-6}
    errors |= {"viscous_friction": 2e-6, "friction_torque": 1e-4}
    result = PhysicalResult("current", values, errors, ("inductance",), (0.01532,), ("Look.",))
    rows = [line.split(maxsplit=4) for line in format_physical(result).splitlines()[1:]]
    assert rows == [
        ["resistance", "2.3001", "0.0011", "Ω"],
        ["inductance", "–", "–", "mH", "not identifiable"],
        ["torque_constant", "65", "–", "mN·m/A", "given"],
        ["inertia", "1400", "20", "g·cm²"],
        ["viscous_friction", "0.1", "2", "µN·m·s/rad", "consistent with zero"],
        ["friction_torque", "10.00", "0.1", "mN·m"],
    ]
    assert list(list_physical_notes(result)) == [
        "Look.",
        "The fitted current is within 15.32 mA RMS of the measured one.",
    ]
