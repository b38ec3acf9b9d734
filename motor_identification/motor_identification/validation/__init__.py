"""Validate a fitted motor on held-out motion, which no fit has seen.

In: a problem, θ, and what was kept out. Out: the validation error (gap), its floor, its likelihood. Nuisance
parameters, which belong to a recording and not to the motor, are estimated on alternating blocks that the gap leaves
out.
"""
