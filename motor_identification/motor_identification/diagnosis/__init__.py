"""Name the missing effects: stepwise model selection by likelihood ratios on held-out motion.

`forward_selection` adds one effect after the other, each tried by `fits.effect_fit` and judged by `effect_test`;
`backward_elimination` takes back what is not needed beside the others; `verdict` says how it ended.
"""
