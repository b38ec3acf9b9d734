"""Tell a supply that is off from one that is low; all that judge a measured supply go by this."""

# Of the voltage that is expected, the motor's or that of its supply: less turns no motor that is meant for it.
SHARE = 0.25
# [V] A supply that is off reads a little: through a bridge's diodes, of what a motor that still turns makes, through a
# divider. That does not grow with the motor's voltage, and 4 V on the bench of a 24 V motor are a supply.
MOST = 3.0


def find_least_supply(expected: float) -> float:
    """Find the voltage [V] below which a measured supply is off where so many volts are expected."""
    return min(SHARE * expected, MOST)
