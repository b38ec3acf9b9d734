"""A simulated motor with an honest encoder that swaps in for the real board."""
