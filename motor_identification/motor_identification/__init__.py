"""Fits motor models to recorded bags by particle swarm and least squares; experiments, recording, replay, import."""
