"""A motor in ohms, newton-metres and kilograms, from a fit in armature voltages.

In: a fit of the motion, with recordings that have a current (or a resistance that is known otherwise). Out: resistance,
inductance, torque constant, inertia, friction, each with its standard error (`result.py`).
"""
