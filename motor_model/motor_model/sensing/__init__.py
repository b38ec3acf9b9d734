"""Simulate what a board reports (edges of an irregular disc, their stamps, the sampled speed), and judge it.

Samples go through `motion_check` (does the motor move as its voltage wants; with `heating` and `against_voltage`) and
`mains_rhythm` (are edges the mains' hum); `repeated_stops` says how soon a motor may go on after a stop.
"""
