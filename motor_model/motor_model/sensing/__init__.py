"""Simulate what a board reports: edges of an irregular disc, the timer that stamps them, the sampled speed."""
