"""Set the thresholds of the diagnosis: every number that decides what is a finding, and what set it.

"Gap" is the validation RMS error, "floor" what the encoder alone leaves in it. "Measured" are the motors of
`benchmarks/hidden.py`: nothing hidden, 17 single effects, 10 pairs, and 9 with something that is not in the table.
"""

# Is anything left to explain?
# Times the floor. Measured: complete models end at 0.95 to 1.08 (the floor's irregularity is estimated, phases and
# instants of validation recordings are fitted on half of them), models that lack what is not in the table at 9 to 135.
EXPLAINED_GAP = 1.3
# [s] of joined intervals, at least, in which the encoder's steps average out: what is left there lasts. A slow motor's
# time constant where that is longer, in which a torque moves it; but so many have to fit into the held-out motion.
# Measured: with 0.1 s what a robot of 0.75 s lacks is the wheels' slip alone. Tried: a time constant of 0.09 s alone,
# and of three effects of a coarse encoder, which share what lasts, two are lost.
LASTING_INTERVAL = 0.1
# Intervals in which they average out as well: 0.1 s at 200 Hz. Measured: in 0.1 s at 1 kHz a chirp of a motor of 7 ms
# averages out itself, and its friction, likelier by 465, with it.
LASTING_ROWS = 20
LASTING_PARTS = 15
# Times the floor in lasting intervals; below it no effect is tried. Measured: complete models leave 0.84 to 1.5 (few
# intervals: the ratio is unsure), so that this only spares time where the ratio is low by chance.
QUIET_GAP = 1.05
# Of the white noise that was assumed of speeds: a model that leaves less has shown that it was too high, and its floor
# is what it leaves itself; below it no floor ends the search. As far below as EXPLAINED_GAP is above.
LEARNED_NOISE = 1.0 / EXPLAINED_GAP

# Times the floor in lasting intervals; above it findings have to hold beside a random torque, however coarse the sensor
# is from sample to sample. Complete models, as above, leave up to 1.5.
LASTING_GAP = 2.0

# Is an effect likely?
# Chance that a complete model is given any effect that it does not have. By Markov's inequality a likelihood ratio on
# unseen data exceeds n/rate with a chance of at most rate/n for each of n effects, see `noise/likelihood.py`.
FALSE_ALARM_RATE = 0.01
# Of log likelihood: a ratio of e^0.5 = 1.6 is no evidence. In backward elimination, and of which partners are tried.
TIE_LIKELIHOOD = 0.5
# The same where all data choose between what held-out data hardly tell apart: e^3 = 20 is called strong evidence (R.
# Kass, A. Raftery, "Bayes factors", J. Am. Stat. Assoc. 90, 1995), and the more common effect is that much likelier
# before any data. Measured: an inductance by 3 on one split of a real log, a delay by 1 on all of it.
COMMON_LIKELIHOOD = 3.0
# Of the evidence of what is at an instant, the least of what needs none and comes first. Measured: 0.97 of a friction
# that a load step stood in for, in steps one way beside a torque, 0.84 of a load that is there all the time; what is
# chosen first stays in such recordings. Of 27 load steps that are there it changed none.
COMES_FIRST = 0.8
# Of the excess over the floor, what takes away more is found before what adds to it, however likely that is. Measured:
# 0.81 of a friction beside a ripple of -0.2 that was ten times as likely, in a slow sine of a real motor.
MOST_OF_GAP = 0.5
# Pairs that are fitted of those that a scan promises about as much of; more of them are other words for the same.
PROMISES_TRIED = 4
# Of log likelihood: what is less likely by e^5 = 150 is no rival of a finding. Measured: where one recording tells two
# effects apart at all, they differ by 615 and more.
RIVAL_MARGIN = 5.0
# Where a finding leaves so many times what cannot be predicted, what leaves more by less than this share of that (in
# squares), and is less likely by less than it, is its rival, too. Measured: 1.18 with a limit of four real runs; 0.09
# and 0.12 of that, and 0.11 and 0.16 of the evidence, with two others.
LEFT_GAP = 1.1
LITTLE_OF_LEFT = 0.2
# The same of a lag that leaves more of unseen motion. Measured: an inductance by 7.5 beside a random torque, in place
# of a dead time, which was likelier by 16 without one.
CONTRADICTED = 10.0
# Of the log likelihood by which a dead zone is likelier than nothing, by how much it is likelier than the friction that
# every motor has. Measured: 0.02 to 0.29 where a friction was beside something that had no name, or was blurred by the
# sensor; 0.42 to 1 of dead zones that were there.
HOLDING_LEAD = 0.35
# Where there are that many recordings, most must not be against it; and the share of them that may alone be for it.
# Measured: 22 of two of ten runs of a real motor for one lag, -6 of the others.
FEWEST_RUNS = 5
FEW_RUNS = 0.2

# Is it relevant?
# Times the floor in lasting intervals, which the gap before has to be: below, the excess is a difference of equals.
# With RELEVANT_SHARE it also demands that 4 % of that gap go.
RELEVANT_GAP = 1.15
# The same where nothing is held out, and a slow torque is fitted by whatever answers the speed alike: complete models
# leave up to 1.5. Measured: 1.28 for a load of 0.035 V that stood in for a torque of 0.015 V.
SEEN_GAP = 1.5
# Of the excess over the floor (in squares, in lasting intervals) that a finding explains at least. Measured: right ones
# explain 0.54 to 1 of it, beside other hidden ones too; what a wrong one explains by chance is near 0.
RELEVANT_SHARE = 0.3
# The same where the gap before is at the floor already, and chance has a larger part in what little is left; and times
# the floor (in lasting intervals), up to where that holds. Measured: complete models leave up to 1.5. The same for what
# has an instant in each of several recordings.
RELEVANT_SHARE_NEAR_FLOOR = 0.5
NEAR_FLOOR = 2.0
# The same where nothing is held out. Measured: 2.07 for a load of 0.035 V that stood in for a torque of 0.075 V, and
# explained 0.4 of what lasted; 2.58 for the friction of a real motor, 0.38.
NEAR_FLOOR_SEEN = 2.3
# Time constants after a change of the command in which the motor answers it, and all that makes it late shows.
ANSWERING_LAGS = 3.0
# Of the time: the moments in which a model leaves most, whatever that is; and of what lasts outside of them, what a
# friction takes away that is seen there. Measured: 0.82 to 0.98 for the frictions of four robots whose wheels slip in a
# hundredth of the time, which leaves 0.2 to 0.8 of it all; 0.35 where they slip all the time.
WILD_TIME = 0.05
CALM_SHARE = 0.7
# Of the white residual's power beside a random torque, which no floor is known for: less is nothing to name.
RELEVANT_WHITE_SHARE = 0.01
# Rows of a time constant that this is of, at most: finer ones, of a slow motor, say no more about its motion. Measured:
# a warm-up by 63, which takes away a third of the gap, in 28,000 rows of a motor of 0.5 s.
RELEVANT_ROWS = 12.0
# Times the gap before: so much it may grow by chance where a finding is fast beside the random torque that the gap is
# mostly of, or where the held-out motion beside that torque speaks for it. Measured: 1.03 with a ripple of 0.3 V beside
# a torque of 0.1 V, the same with a friction by e^26 beside 0.075 V in a log at 50 Hz; where a model fits the torque
# instead of the motion 1.3 and more.
GAP_CHANCE = 1.1
# Beyond this what lasts may not grow by more than that either, for a coarse sensor's gap is mostly its own noise.
# Measured: gaps of 1.05 and 1.08, of which what lasts was 1.18 to 1.5, with a drag and a breakaway that are not there;
# of 1.002 to 1.02, of which it was 1.05 to 1.2, with a sag and two frictions that are.
GROWN_GAP = 1.03
# The same where held-out motion speaks for a finding less: a coarse sensor's gap is its own noise, whatever is found.
# Measured: 1.0008 with a friction of 5 % of the supply, likelier by 38, of counts of which a row has one or two.
GAP_TIE = 1.005
# Times the gap of a model at the sensor's floor, beside no torque at all: a lag leaves less than that, or is of the
# recording. Measured: 0.998 of a delay of 0.09 ms where there is none.
SHRINKING_GAP = 0.98
# The same in lasting intervals, which a coarse sensor hides. Measured: 0.85 of an inductance of a speed loop, likelier
# by 110, of whose gap 0.986 stays.
SHRINKING_LASTING_GAP = 0.9
# Rows, of a lag that is the motor's whatever it takes away: a row's stamp is late by a part of it. Measured: a delay
# of one row of 1 ms, 0.998 ± 0.011, by whose evidence of 184 0.92 of what lasted stayed.
LATE_ROW = 0.5
# Times the gap before: what leaves less predicts all the time, whatever a slow torque does in some moments. Measured:
# 0.34 to 0.74 of frictions and drags that fewer moments speak for; 0.96 and more of what is not there.
PREDICTING_GAP = 0.8
# Times the gap of a model, beyond which one without a finding, or with another in its place, predicts far worse.
# Measured: 6 and 1.7 where a load step or a warming-up that is there goes, 1.02 and 1.13 where it is chance.
WORSE_GAP = 1.5
# The same of motion that the fits have seen, however likely: beyond, a torque was learned in the place of the motor.
# Measured: 7.0 of a dead time, friction and inductance in a log one way, for which a slow torque of 3 % stood, likelier
# by 70, and 60 where it was of five times the supply; 1.9 of a real gearmotor that breaks away.
TORQUE_AS_MOTOR_GAP = 3.0
# Of a gap on unseen motion in which nothing certain was found alone: what leaves less is kept, though structure is
# left. Measured: 0.34 to 0.44 for a friction under a coasting bridge in four logs of two rigs that have more; 0.9 and
# more of 24 simulated motors with effects outside the table.
HALVED_GAP = 0.5
# Of the gap behind a filter, what leaves no more without one shows that it is none, whatever else is missing. Measured:
# 0.15 of a play that was taken for one.
FAR_LESS_GAP = 0.25
# What two effects leave of the gap beside a random torque that made a model complete, one of which opens it alone.
# Measured: 0.31 and 0.42 of a friction on a coasting bridge; 0.84 of a real log, with a constant load that is not
# there.
CLOSED_GAP = 0.7
# Correlation times of a torque, below which a recording that the fits have seen whole has too few courses of it to tell
# it from a friction or a load. Measured: 3.6 in one step from 5 to 15 V of a real gearmotor, whose friction is likelier
# by 540 alone; 30 of a torque of 0.2 s in the shortest recordings of the tables.
FEW_COURSES = 5.0
# Times the gap of a model: within it another that is as likely is the same motion in other words, such as a friction
# and a dead zone where the motor never turns back; what differs is how far a fit of each had converged.
SAME_GAP = 1.001
# Of the sensor's floor: two models that move so little apart are one. Measured: 0.0003 for a load that begins with the
# recording and a constant one.
SAME_MOTION = 0.01
# Waves of a line over the angle, at least, and those from which on it is its own evidence. Measured: 1.7 of 0.02 V for
# a torque of 0.04 V, in a motor that swung to and fro; 4.6 of 1,924 cycles a turn in strokes of 0.015 rad of a real
# motor, where friction had another shape at its reversals; 35 and more for ripples that were there.
LEAST_WAVES, MANY_WAVES = 6.0, 30.0
# Turns, at least, of an eccentric disc that takes away most of what is left (`MOST_OF_GAP`), and is likelier than a
# load that goes round with it. Measured: 1.0 to 1.2 of it for three in 1.2 to 3.8 turns, likelier by 179 to 1,073 and
# than such a load by 190 and more; a friction that goes with the angle was likelier as a load by 402, in 3.9 turns.
LEAST_TURNS = 1.0
# The same of a load that goes round once a turn, and of the excess over the floor, what it takes away at least.
# Measured: 0.99 of that friction. Other cycles may be any slow torque where the fits have seen them. They were
# 0.95 and 0.92, held out, of a ripple of four a turn that a motor went to and fro over in one turn.
LEAST_TURNS_OF_LOAD, NEARLY_ALL_OF_GAP = 3.0, 0.9
# Likelihoods that the search for a candidate's errors may ask for, and that for a model's to begin with.
CANDIDATE_EVALUATIONS, FINAL_EVALUATIONS = 40, 120
# How often a candidate is fitted beside the torque that it leaves itself, at most: each leaves less of one. And of log
# likelihood, as how much less likely, and times the gap, as leaving how much less, it is fitted so at all. Measured: an
# asymmetry of 0.9 was found as 0.95 (-1.5, the gap 12.5 to 10), then as 0.92, 0.90 and 0.89 (+3.1, +6.5 and +7.0).
REFINEMENTS, HELD_BACK, HELD_BACK_GAP = 3, 10.0, 0.95
# RMS of a random torque: by how much a motor breaks away above its sliding friction, beside one. Measured: 1.73 and
# 1.76 where a ripple and a friction were all there was, likelier by 12 and 90; 2.6 and more where it breaks away.
BREAKAWAY_SIGMA = 2.2
# How often a model is fitted again from where the best finding leads, beside a random torque.
VERIFICATIONS = 3
# Cycles a turn, beside one: a torque so near to it is what such slots do, where they are likelier. Measured: 3e-5.
ONCE_A_TURN = 0.05
# [s], and time constants of the motor, of which a recording that lasts for less than either does not show what comes
# slowly: a winding heats up within many of them, and hardly within seconds. Measured: a warming-up by 0.6, the most
# that is searched, in 3.8 s and 36 of them of a toy robot with a dead zone.
SLOW_TIME, SLOW_CONSTANTS = 10.0, 300.0
# Of a recording, from when its motor is first driven or moves: what begins within it is there from the start. Measured:
# 0.0 to 0.003 s for a load that came in with the initial speed of a real motor; 0.06 of 8 s after the first step for a
# friction that builds up.
FROM_THE_START = 0.02
# Time constants after that, too: a motor that is on its way from its first step has shown no state in which a load was
# not there. Measured: 1.8 for the constant load of a real motor in a speed loop.
ON_ITS_WAY = 2.0
# Of the largest value that physics allows: a search that ends there ends with it. The others end at what is usual: a
# disc of 0.2 rad off its centre was fitted to a torque where there was none.
NEAR_PHYSICS = 0.9
# Standard errors that the size of an effect is beyond none at least: one of some twenty effects is two off by chance.
# Measured: beside a torque of 0.1 V a load step of 0.04 ± 0.13 V in a motor with backlash, a delay of 1.5 ± 2.1 ms;
# 2.2 of a sagging supply beside a slow torque, 2.7 of a load in a motor whose friction goes with the angle; right ones
# 3.2 and more, but for one of 2.6: a dead zone beside the friction that takes its place in part.
SURE_SIZE = 3.0
# The same by a fit that knows of the random torque beside it. Measured: 30 and 160 of frictions that were 2.9 and 2.2
# by their encoders, in motors that a torque moves as slowly as they are; its errors are up to half too small.
SURE_BESIDE_TORQUE = 10.0
# The same where held-out motion, too, speaks for it all the time. Measured: 4.7 of a dead zone that
# was 2.8 by a tachogenerator, 5.9 of a friction beside play that was 2.1 by its counts.
STEADY_BESIDE_TORQUE = 4.0
# Of log likelihood without its few best moments, the same whatever a standard error says. Measured: 179 of a bridge
# that coasts, found as 1.00 ± 0.33 beside gains of runs.
STEADY_LIKELIHOOD = 30.0
# Of log likelihood: what is at an instant has to be likelier beside a random torque or in motion that the fit has seen,
# for the instant is the best of hundreds. Measured: 13 of a load step that stood in for a friction and a load in one
# response of a position loop, 17 where a real wheel coasts at no command alone; right ones 28 and more.
INSTANT_LIKELIHOOD = 20.0
# Of a recording: the standard error of an instant, in all of them, from which on nothing came at one. Measured: 0.063
# and 0.088 for a load step that stood in for a coasting bridge's rest, and a limit, beside slow torques; right ones
# 0.0175 and less.
VAGUE_INSTANT = 0.035
# Standard errors, the same of what repeats with the angle: there are many lines. Measured: 2.1 of an eccentricity of a
# tachogenerator, which has no disc.
LIKELY_LINE = 3.3
# The same where the fits have seen all that it is judged by. Measured: 3.8 of an
# eccentricity in six parts of one step of a motor that has none; right ones 6 and more, which their price asks for.
SURE_LINE = 5.0

# May it only stand in for what is not in the table?
# Of the excess over the floor: what explains less, and leaves the gap above the floor, may. Measured: the right single
# effect explains 0.98 and more, a wrong one in its place up to 0.94 (drag as coasting, a limit as sag; beside others up
# to 0.93, a slewing bridge as a delay).
STAND_IN_SHARE = 0.95
# The same where all that can be predicted of the rest goes with the angle or the time alone. Measured: 0.47 for the
# friction of a robot on a floor that is not the same everywhere. A stand-in for a friction over the angle, or a supply
# that swings, is not even relevant.
APART_SHARE = 0.4
# The same of what comes slowly, which goes with the time itself. Measured: 0.91 to 0.95 of windings that are heated by
# what the drive puts into them; 0.33 and 0.51 of a friction that grows, 0.72 to 0.81 of a supply that runs down.
SLOW_SHARE = 0.85
# Of the excess: what explains less by no more than that without an instant may be there instead of what needs one.
# Measured: 0.002 between a friction and a load that stepped at the only step of a real motor's command.
NEARLY_AS_MUCH = 0.02
# Of the share that goes with the past: what goes with speed, voltage or drive beside that. Measured: 0.17 in a loop
# with a filtered tachogenerator, 0.8 where a friction is not the table's.
MINOR_SHARE = 0.3
# Of the log likelihood that a backlash gains: what a friction that builds up after a reversal gains in its place.
# Measured: 0.52 to 1.4 where such friction is in the motor, 0.25 and less where a backlash is, beside torques of 0.2 to
# 2.5 % of the supply; next to none (of 20 to 50) for two such frictions in motors that turned round a few times.
PRESLIDING_SHARE = 0.4
# Of log likelihood: what a bridge that slews gains beyond the lag that stands in for it. Measured: 130 to 1,900 where
# a bridge slews (and -14 where one level each way leaves nothing to tell them by), -45 to -2,000 for lags.
SLEWING_GAIN = 20.0
# The same of a supply that runs down beyond the warming-up that stands in for it. Measured: 360 to 1,100 where one
# does, by 10 to 17 %; -3,100 to -120 of warming-ups.
DROOPING_GAIN = 20.0
# Of log likelihood: what a friction over the angle gains beyond a torque ripple, and its size, of the ripple's that
# stands in for it. Measured: 130 to 1,000 and 1.1 to 1.3 where there is such a friction; beside ripples -2,000 to -20,
# and 50 to 950 of 0.28 to 0.37, of large ripples of slow motors, which no line describes.
ANGLE_FRICTION_GAIN, ANGLE_FRICTION_SIZE = 20.0, 0.6

# Times the gap without it: where nothing explains what is missing, what leaves less is worth telling. Measured: 0.46
# for friction under a coasting bridge, of a real motor whose current is gone before the off time ends.
NEAREST_GAP = 0.7
# Of what a selection takes away, in squares: the first of its effects that do as much are told, without the rest.
MOST_OF_NEAREST = 0.8

# Does it hold the motor?
# Of squares of travel, in units of the sensor's own: what a model moves where the motor stood under a voltage. A motion
# of ten slots, or one interval in which a speed that was measured as zero is off by ten standard deviations.
LEAST_FALSE_MOTION = 100.0
# Times that a motor set off from rest: of one or two, where it stood may have been a hill of a torque over the angle.
FEW_DEPARTURES = 2
# Of those squares: what an effect takes away that holds the motor. The rest, 70 % of the travel, is of a level that
# everything else in the recording pulls at. Measured: 0.66 and 0.94 for the frictions of two robots beside what is not
# in the table, 0.17 and less for a delay and a voltage limit in their place.
HELD_SHARE = 0.5
# Standard deviations of a logged speed's noise within which a motor stands, if it does so under a voltage for so many
# of its time constants. Measured: 1.5 rad/s of a motor at rest by its model, behind a filter that was undone.
STILL_SIGMA, STILL_CONSTANTS = 3.0, 2.0
# Of the largest voltage in a recording: less need not move any motor.
HOLDING_VOLTAGE = 0.01

# How far is searched?
MOST_FINDINGS = 5  # more than any motor had that was measured: four of 310 public recordings
# The same where another one is likelier than one of those. Measured: an asymmetry by 246 as the sixth, of a motor with
# friction, bias and delay, beside a load step by 48 and a dead zone by 99 that had stood in for it.
MOST_WITH_STAND_INS = 7
# Of a step alone, or a response as short: a second effect only bends the first one's curve, unless it explains all the
# rest (`STAND_IN_SHARE`). Measured: drag of a motor that had friction and a delay, coasting of one on a braking bridge;
# and a delay beside a friction in a speed loop, which left a seventh.
MOST_OF_ONE_RESPONSE = 1
# Times the floor, of the middle half's scatter: where most intervals are as near, a few miscounted ones may be all that
# is wrong. A gap of 1.3 is explained, and twice that again is left to the tails of what is half left out.
MISCOUNTED_GAP = 3.0
# How often a selection beside a random torque goes on where elimination changed it. Measured: once is enough.
ROUNDS = 2
# How often a model beside a random torque is fitted again by the errors that it leaves itself, and by how much log
# likelihood each time has to gain. Measured: 70, 20, 5, 2 along the ridge of a delay and an inductance; else below 1.
SETTLING_ROUNDS, SETTLED_LIKELIHOOD = 6, 1.0
# Effects that are tried together with any other, where none alone is a finding. 3 × 17 fits take half a minute.
PAIR_PARTNERS = 3
# Of the excess over the floor, what an effect that others come with takes away at least, however unlikely it is alone.
# Measured: 0.7 of a friction of a motor that breaks away 7 times as heavily, likelier by -54, with that by +315.
COMPROMISE_SHARE = 0.1
# Findings from which on no pairs are tried any more: what is not in the table would cost minutes.
PAIR_MOST_STEPS = 2
# Findings of a complete model from which on another first one is tried: together, several imitate what two do.
# Measured: a dead zone, a coasting bridge, a load and drag for a static friction.
MANY_STEPS = 3
# First effects that are tried instead of the most likely one where the gap stays above the floor, and the share of its
# evidence that they need: measured, right first ones had 0.8 and more of a wrong one's.
SECOND_STARTS = 2
# Time constants of the motor, beyond which a torque's correlation time is one of what happens at rest. Measured: 52 of
# a limit in a staircase of 25 levels of 5 s, which stood in for a friction under a coasting bridge; 1 to 4 of those of
# 0.2 s.
SLOW_TORQUE = 10.0
SECOND_START_EVIDENCE = 0.75
# Effects that are tried instead of a finding in backward elimination: the likely ones where it was found.
ELIMINATION_RIVALS = 3

# Is it a missed edge?
# Miscounted intervals from which on edges are missing: one to four may be wrong stamps.
LEAST_MISSED_EDGES = 5
# Standard deviations of what sensor and random torque leave, beyond which an interval that is short by whole slots has
# lost edges: chance makes one of 11,000 that short, and five of 10,000 in two recordings of a thousand.
MISSED_EDGE_SIGMA = 3.75
# Of a slot, at least and at most: how near to a whole one an interval is that lost an edge, within two standard
# deviations of its travel; a motion that went astray is anywhere.
WHOLE_SLOT = (0.2, 0.4)
# Of the edges that are missing: intervals that are far off otherwise. Missed edges leave next to none, a simulated
# motion that goes astray now and then at least as many.
MOST_ODD = 0.5

# Is the rest random?
# Times the noise floor of sensor and random torque together: a gap beyond is not what that torque leaves. Measured on
# complete models beside 0.03 and 0.15 V: 0.92 to 1.12; slewing bridges that an inductance
# stood in for: 0.29 to 0.84.
RANDOM_GAP = (0.75, 1.33)
# Standard deviations that it may be off by chance beyond: a few held-out seconds have few samples of a slow torque.
# Measured: 0.72 in the two held-out seconds of a log, an eccentricity of one slot beside a torque of 0.13 s.
RANDOM_SIGMA = 2.0
# Times, at most: a torque that is as slow as the recording describes anything.
MOST_CHANCE = 1.5
# Times that floor, beyond which what a complete model leaves in few moments is no longer chance. Measured: 5.7 of ten
# runs, each of which began late by another time, beside one dead time for all; complete models as above.
MOMENTS_GAP = 3.0
# Of the largest voltage: beside a random torque of more (RMS) nothing is explained. Measured: up to 0.025 is what gears
# and loads were given; 0.115 stood for a play of gears whose load coasts, 0.067 for a bridge that slews.
MOST_TORQUE = 0.05
# Of kv: as much as it may be another beside an effect that was not to be seen, by what is right for small changes.
MOST_IMITATION = 0.5
# Of kv, and its standard errors: by how much it has to be another.
IMITATION, SURE_IMITATION = 0.02, 3.0
