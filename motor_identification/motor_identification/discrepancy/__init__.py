"""Locate where simulation and measurement disagree: over speed, voltage, angle and time.

In: residuals on held-out motion. Out: maps of the residual, the worst regions in words, the torque that is missing.
"""
