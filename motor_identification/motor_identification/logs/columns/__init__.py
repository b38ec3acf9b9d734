"""What columns of a log mean: names and numbers in, quantities with units and the motor they belong to out."""
