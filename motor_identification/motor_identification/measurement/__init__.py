"""Turn a recording into intervals: mean speeds between instants at which the shaft's angle is known.

In: a checked `Recording` (edges with stamps, sampled counts, or speeds only). Out: `Intervals`, with directions, times
of standstill and the initial speed. Nothing here knows a motor model.
"""
