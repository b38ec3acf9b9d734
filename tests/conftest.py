"""What holds for all tests."""

import motor_identification  # noqa: F401  (before NumPy: it keeps BLAS to one thread)
