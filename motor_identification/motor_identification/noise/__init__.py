"""Model what the sensor leaves in angle increments: likelihood, whitening filter, table of irregular slots.

In: intervals and the increments (simulated less measured angle) that a model leaves in them. Out: their logarithmic
likelihood, white residuals of variance 1, and the offset of every slot of the disc.
"""
