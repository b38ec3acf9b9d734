"""The real motor: talks over a serial port to the board that drives it and stamps its encoder's edges."""
