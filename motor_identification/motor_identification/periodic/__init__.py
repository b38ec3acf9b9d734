"""Fit effects that repeat with the shaft's angle (torque ripple, eccentricity of the disc).

Their phase is lost on a simulated angle that drifts, so they are fitted on measured angles, from lines in the residual
torque's spectrum. In: a fit of all other effects. Out: the fit with them.
"""
