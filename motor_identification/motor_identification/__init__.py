"""Fits motor models to recorded bags by particle swarm and least squares; experiments, recording, replay, import."""

import motor_model  # noqa: F401  (before NumPy: it keeps BLAS to one thread)
