"""What the column of a motion is: its kind and unit, which way it is forward, what was counted beside it."""
