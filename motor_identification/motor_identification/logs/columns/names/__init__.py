"""What a column's name tells: its words, the side of a machine among them, and the quantity that they tell."""
