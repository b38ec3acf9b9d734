"""Find the sensor that nobody described: the lattice of its values, how long each is held, its white noise.

In: recorded speeds or counts and their times. Out: a `SpeedSensor`, or the rows of a count that are fresh. Nothing here
knows a motor model, and nothing is asked of the user.
"""
