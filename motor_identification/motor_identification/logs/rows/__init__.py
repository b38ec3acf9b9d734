"""Puts the rows of a log in order: runs, stamps, wraps and resets, held values; each step says what it did."""
