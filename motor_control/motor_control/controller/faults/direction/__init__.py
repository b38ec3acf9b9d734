"""Detect a motion that the voltage does not drive: exchanged channels or wires, a bridge that stays on, a heavy load.

In goes what a sample shows (`evidence`), out comes a sentence, or none:

    runaway       the voltage is 0 or strongly against the motion, and yet the speed grows
    pulses        pushes against the motion, beyond what a load takes, that make it faster
    plugging      a motion that the voltage against it, all that `plug_limit` leaves, does not slow down
    implied_load  a motion against the voltage that, by the model, only a load could make that no motor may have
    unslowed      0 V, and a motion that goes on as it was
    to_and_fro    edges that are counted to and fro under a voltage that turns any motor: a channel is lost
"""
