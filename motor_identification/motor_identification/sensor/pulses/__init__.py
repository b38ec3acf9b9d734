"""Speeds by the period method: a slot over the time between edges."""
