"""How much a search may be asked for, by a parameter or by a request."""

MOST_PARTICLES = 100_000
MOST_EPOCHS = 1_000_000
