"""MCAP files: `records` knows what bytes mean, `summary` the index at the end; `file` reads from front to back."""
