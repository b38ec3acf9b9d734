"""Fit a motor with one effect more, or beside a random torque: θ → θ."""
