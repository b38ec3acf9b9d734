"""Inputs that somebody made to do harm, and a place to try them in: for tests and for benchmarks/hostile.py."""
