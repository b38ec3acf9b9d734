"""The selection of what is missing: added, taken back, exchanged, dropped."""
