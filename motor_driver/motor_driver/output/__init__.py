"""The board's output: on by the user's wish alone, as this driver told the board, and as it commands it."""
