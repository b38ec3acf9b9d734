"""Thresholds of the diagnosis: every number that decides what is a finding, with what set it.

"Gap" is the validation RMS error, "floor" what the encoder alone leaves in it; ratios are gap over floor.
"""

# Is anything left to explain?
EXPLAINED_GAP = 1.3  # times the floor: a complete model's gap. The floor's irregularity is estimated, and a nuisance
# parameter (a phase, a load step's time) is never exact: complete models of the confusion table end at 0.9 to 1.25.
LASTING_INTERVAL = 0.1  # [s] intervals joined to this length show what lasts: a coarse encoder's steps average out in
# it, a motor's time constants (ka/kv, some 0.1 s) do not.
QUIET_GAP = 1.05  # times the floor in lasting intervals, less than RELEVANT_GAP: below it no effect is tried at all

# Is an effect likely? (Markov's inequality on the likelihood ratio, see `noise/likelihood.py`)
FALSE_ALARM_RATE = 0.01  # chance that a complete model is given an effect that it does not have
TIE_LIKELIHOOD = (
    0.5  # of log likelihood: a ratio of 1.6 is no evidence, the effect that is earlier in the table is taken
)
RIVAL_MARGIN = 5.0  # of log likelihood: what is less likely by e⁵ = 150 or more is no rival of a finding

# Is it relevant?
RELEVANT_GAP = 1.15  # times the floor in lasting intervals, which the gap before has to be: below, no share is sure
RELEVANT_SHARE = 0.3  # of the excess over the floor (in squares, lasting) that a finding has to explain
RELEVANT_SHARE_NEAR_FLOOR = 0.5  # the same where the gap is at the floor already: what is left there is small
LEAST_LASTING_DROP = 0.03  # of the gap in lasting intervals that has to go
LEAST_DROP = 1e-3  # of the gap itself that has to go in any case
CHANCE_HARMONIC = 5.0  # times the first harmonic that random slots have by chance, which an eccentricity has to exceed

# May it stand in for what is not in the table?
STAND_IN_SHARE = 0.95  # of the excess: what explains less and leaves the gap above the floor may stand in

# How far is searched?
MOST_FINDINGS = 6
MISCOUNTED_GAP = 3.0  # times the floor: the middle half's scatter below which a few miscounted intervals may be all
PAIR_PARTNERS = 3  # effects that are tried together with any other where none alone is a finding,
PAIR_MOST_STEPS = 2  # and fewer than so many findings are there already: what is not in the table would cost minutes
SECOND_STARTS = 2  # other first effects that are tried where the gap stays above the floor,
SECOND_START_EVIDENCE = 0.75  # and the share of the first one's evidence that they need
ELIMINATION_RIVALS = 3  # effects that are tried instead of a finding
LEAST_MISSED_EDGES = 5  # miscounted intervals from which on edges are missing: one or two may be wrong stamps
