"""Which serial port has the board that is meant, and what is wrong with one that cannot be opened."""
