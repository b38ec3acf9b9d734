"""Estimate parameters by output error: simulate, compare mean speeds, minimise the weighted square.

In: recordings and the effects to fit (`Problem`). A particle swarm searches the whole box from several seeds
(`multistart`), trust-region least squares ends each descent, and `whitened_fit` makes the last step efficient. Out: θ.
"""
