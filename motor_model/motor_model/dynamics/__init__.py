"""Integrate the motor's equation: one compiled step (`motor`), its forces, the bridge, and the inverse.

Piecewise closed form: each piece of the motion is linear (`linear`), ends at an event (`events`), and is as long as the
error allows (`pieces`).
"""
