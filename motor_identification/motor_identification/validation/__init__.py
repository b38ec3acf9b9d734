"""Validate a fitted motor on held-out motion, which no fit has seen.

In: an estimate, and what was kept out (`hold_out`: other recordings, or blocks of the same). Out: the simulated motion
beside the measured one, the validation error (gap), its floor, its likelihood (`held_out`). Nuisance parameters, which
belong to a recording and not to the motor, are estimated on alternating blocks that the gap leaves out
(`nuisance_fit`).
"""
