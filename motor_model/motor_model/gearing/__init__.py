"""The encoder and the gear in whole numbers: counts a turn, and the output angle that counts stand for."""
