"""PI speed controller that acts on every encoder sample."""

import motor_model  # noqa: F401  (before NumPy: it keeps BLAS to one thread)
