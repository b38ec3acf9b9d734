"""The observer's compiled arithmetic: a Kalman filter over angle, speed and load whose mean is the motor model's step.

It stands in a folder of its own so that its machine code is kept until one of these files changes.
"""
