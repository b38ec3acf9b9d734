"""The observer's compiled arithmetic: a Kalman filter over angle, speed and load whose mean is the motor model's step.

In go a filter state, the commands on their way and a sample's edges; out come the next state and a speed. Entry:
`sample_update`, then `prediction` between edges, `edge_update` (which asks `flank` and `load_jump`) at an edge,
`no_edge_update` where none came; `direction_hypotheses` runs two of them where a single channel leaves the direction
open. Every function returns new values and changes none that it was given.
"""
