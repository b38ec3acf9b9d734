"""One recording of a log."""

from motor_identification.logs.run import Run
from motor_model.sample import Sample


def test_how_long_it_is() -> None:
    samples = tuple(Sample(10**18 + 5_000_000 * k, 0.0, 0.0, 0, 0, 0.0, 12.0, 0.0) for k in range(5))
    assert Run("", samples).duration == 0.02
