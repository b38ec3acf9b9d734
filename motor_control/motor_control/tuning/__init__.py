"""Tune the speed loop: from a motor model to gains, their margins, and what they will do.

`design` is the entry; the loop is linear and sampled (`linear_loop`), its margins come from python-control.
"""
