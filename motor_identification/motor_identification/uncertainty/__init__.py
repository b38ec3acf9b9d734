"""Judge how sure a fit is: standard errors, what cannot be identified, whiteness, consistency of recordings.

In: a whitened fit. Out: `Fit`, the result that a user gets.
"""
