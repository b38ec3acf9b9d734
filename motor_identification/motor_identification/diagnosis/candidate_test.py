"""Compare a model with and without one more effect on held-out data, and decide whether that matters."""

from dataclasses import dataclass
from functools import cached_property
from math import comb, log

from motor_identification.diagnosis import thresholds
from motor_identification.diagnosis.candidate_model import Model, find_lasting_interval
from motor_identification.diagnosis.evidence.calm_evidence import explains_calm
from motor_identification.diagnosis.evidence.change_evidence import explains_changes
from motor_identification.diagnosis.evidence.standstill_evidence import explains_standstills, was_held
from motor_identification.diagnosis.evidence.torque_evidence import measure_speaking, measure_steadiness
from motor_identification.validation.held_out import HeldOut
from motor_identification.validation.instants import comes_slowly, needs_instant
from motor_model.effects import EFFECT_BY_NAME, LAGS


@dataclass(frozen=True)
class CandidateTest:
    """A model with one more effect, beside the one without it."""

    effect: str
    before: Model  # without it
    model: Model

    @cached_property
    def held_before(self) -> HeldOut:
        """What the model without it leaves, on the same held-out intervals."""
        return self.before.held.leave_out(self.model.held.instants)

    def _join_lasting(self) -> tuple[HeldOut, HeldOut]:
        """Join what both leave to intervals of the same length, in which what is left lasts."""
        length = find_lasting_interval(self.before.held)
        return self.held_before.joined(length), self.model.held.joined(length)

    @property
    def evidence(self) -> float:
        """Logarithm of the likelihood ratio to the model without it, beside a random torque of the Bayes factor."""
        return self.model.likelihood - self.before.likelihood

    @property
    def evidence_of_all(self) -> float:
        """The same of all data, which flatters a fit by its parameters: to tell effects with as many parameters."""
        return self.model.score.of_all - self.before.score.of_all

    @property
    def fits_training(self) -> bool:
        """Whether the motion that it was fitted to is at least as likely: else held-out phases or instants did it."""
        return self.evidence_of_all >= self.evidence

    @property
    def steadiness(self) -> float:
        """Evidence without the few moments that speak most for it, beside a random torque."""
        runs = len(self.model.held.recordings)
        return measure_steadiness(self.before.score.moments, self.model.score.moments, self._speaking, runs)

    @cached_property
    def _speaking(self) -> float:
        return find_speaking(self.effect, self.model, self.before)

    @property
    def explains(self) -> float:
        """Share of the excess over the noise floor that it takes away."""
        return share_explained(self.held_before.gap, self.model.held.gap, self.model.unpredictable_gap)

    @property
    def has_instants(self) -> bool:
        """Whether the effect has parameters of its own in each of several held-out recordings."""
        several = len(self.model.held.recordings) > 1
        return several and any(spec.of_recording for spec in EFFECT_BY_NAME[self.effect].parameters)

    def is_likely(self, least: float) -> bool:
        """Decide whether the evidence is beyond a least, beside a random torque without its few best moments too.

        Unless much of the gap goes, and so not in a few moments. An instant is one of many, and chosen. What comes
        slowly in motion that the fit has seen is what a slow torque does, too, and has to be as likely.
        """
        if self.is_of_torque:
            return False
        if self.before.held.seen and needs_instant(self.effect):
            least = max(least, thresholds.INSTANT_LIKELIHOOD)
        if self.model.beside_torque and (needs_instant(self.effect) or self._comes_slowly_as_seen):
            least = max(least, thresholds.INSTANT_LIKELIHOOD)
            grows = self._comes_slowly_as_seen and self.model.held.gap > self.held_before.gap
            return self.evidence > least and self.steadiness > likelihood_threshold() and not grows
        return self.evidence > least and (not self.model.beside_torque or self.steadiness > least or self.predicts)

    @property
    def is_of_torque(self) -> bool:
        """Whether a motor breaks away at no more above its sliding friction than a random torque adds, or takes.

        A motor that stands starts when voltage and torque together are beyond its friction, later or sooner than by
        the voltage alone. A torque that lasts for less than a row is rather the sensor's noise.
        """
        spec = EFFECT_BY_NAME[self.effect].parameters[0]
        if spec.at_least is None or not self.model.beside_torque:
            return False
        errors, estimate = self.model.errors, self.model.estimate
        value = estimate.parameters.value
        scatter = errors.rms_voltage if errors.correlation_time >= estimate.problem.sample_period else 0.0
        return value(spec.name) - value(spec.at_least) < thresholds.BREAKAWAY_SIGMA * scatter

    @property
    def is_held_back(self) -> bool:
        """Whether it is no likelier, but leaves less, beside the torque that the model without it needs.

        That is of what is missing, too: as slow and large as it is, it pays for the half of an effect.
        """
        near = self.evidence > -thresholds.HELD_BACK
        return near and self.model.held.gap < thresholds.HELD_BACK_GAP * self.held_before.gap

    @property
    def predicts(self) -> bool:
        """Whether much of the gap goes; of what is at an instant, or repeats, a fit to a slow torque does, too."""
        effect = EFFECT_BY_NAME[self.effect]
        free = effect.anywhere or effect.periodic
        return not free and self.model.held.gap < thresholds.PREDICTING_GAP * self.held_before.gap

    @property
    def _comes_slowly_as_seen(self) -> bool:
        return self.before.held.seen and comes_slowly(self.effect)

    @cached_property
    def relevant(self) -> bool:
        """Whether it takes away a good part of what lasts longer than the encoder's noise, or of the white residual.

        What holds a motor where it stood under a voltage does whatever else is left where it moves. Measured: a wheel
        on the floor stood for 44 % of the time, and a friction of 1.3 V took 14 % of what its dips left away.
        """
        if self.model.beside_torque:
            return self._is_relevant_beside_torque()
        before, after = self._join_lasting()
        floor = after.floor(self.model.noise.share)
        if before.gap < (thresholds.SEEN_GAP if before.seen else thresholds.RELEVANT_GAP) * floor:
            return self.effect in LAGS and explains_changes(self.before, self.model)
        near_floor = thresholds.NEAR_FLOOR_SEEN if before.seen else thresholds.NEAR_FLOOR
        near = before.gap < near_floor * floor or self.has_instants
        least = thresholds.RELEVANT_SHARE_NEAR_FLOOR if near else thresholds.RELEVANT_SHARE
        if self.model.held.gap >= self.held_before.gap:
            return False
        effect = EFFECT_BY_NAME[self.effect]
        calm = effect.holds and effect.linear_onset and explains_calm(self.before, self.model)
        if calm or share_explained(before.gap, after.gap, floor) > least or self._explains_rows():
            return True
        return effect.holds and explains_standstills(self.before, self.model)

    def _explains_rows(self) -> bool:
        """Whether it takes most of what is left from row to row, where the sensor leaves a small part of that.

        Intervals are joined for the sensor's steps to average out, and what a motor does within them does, too. Rows
        that the sensor hides next to nothing of need no joining. Measured: a friction beside a dead time, of a motor of
        84 ms in rows of 50 ms, took away 0.59 of a gap of 5 times the floor, and nothing in intervals of 0.26 s.
        """
        floor = self.model.floor
        seen = self.held_before.gap > thresholds.NEAR_FLOOR_SEEN * floor
        share = share_explained(self.held_before.gap, self.model.held.gap, floor)
        return seen and share > thresholds.RELEVANT_SHARE_NEAR_FLOOR

    def _is_relevant_beside_torque(self) -> bool:
        said = self.model.score.held_out - self.before.score.held_out
        # A slow torque, which most of the gap may be of, is another one beside what is fast or speaks for itself.
        free = EFFECT_BY_NAME[self.effect].periodic or said > likelihood_threshold()
        tie = thresholds.GAP_TIE if said > thresholds.TIE_LIKELIHOOD else 1.0
        shrinks = self.model.held.gap <= self.held_before.gap * (thresholds.GAP_CHANCE if free else tie)
        if shrinks and self.model.held.gap > thresholds.GROWN_GAP * self.held_before.gap:  # more than a sensor's noise
            before, after = self._join_lasting()
            shrinks = after.gap <= before.gap * thresholds.GAP_CHANCE
        if is_same_motion(self.model, self.before) and self._leaves_nothing_that_lasts():
            return False
        rows = min(self.model.score.scored, thresholds.RELEVANT_ROWS * self.model.measure_lags())
        least = thresholds.RELEVANT_WHITE_SHARE * rows * self._speaking
        return shrinks and said > 0.0 and (2.0 * self.steadiness > least or self.predicts)

    def _leaves_nothing_that_lasts(self) -> bool:
        """Whether the model without it is at the sensor's floor already, in lasting intervals too."""
        before, after = self._join_lasting()
        return before.gap < thresholds.RELEVANT_GAP * after.floor(self.model.noise.share)


def find_speaking(effect: str, model: Model, other: Model) -> float:
    """Find the share of the moments in which an effect of a model can speak against another model without it.

    What holds a motor shows where that stood, and starts; a lag where the command changes: of a staircase in one of
    many moments.
    """
    holds = EFFECT_BY_NAME[effect].holds and was_held(model)
    return measure_speaking(other.score.moments, model.score.moments) if holds or effect in LAGS else 1.0


def share_explained(before: float, after: float, floor: float) -> float:
    """Compute the share of a gap's excess over the noise floor, in squares, that is gone after."""
    return (before**2 - after**2) / (before**2 - floor**2) if before > floor else 1.0


def fits_torque(beside: HeldOut, start: HeldOut, lines: bool = False) -> bool:
    """Decide by gaps whether a model beside a random torque fits the torque instead of the motion.

    It predicts worse than the model that the diagnosis began with; or does not even fit better what both have seen.
    lines: all that it has more is fast beside that torque, of which the plain fit to begin with took up some.
    """
    return beside.gap > (1.0 if beside.seen and not lines else thresholds.GAP_CHANCE) * start.gap


def predicts_far_worse(beside: float, plain: float) -> bool:
    """Decide by gaps [rad/s] whether a torque was learned of what a model without it predicts."""
    return beside > thresholds.WORSE_GAP * plain


def takes_away_more(model: Model, plain: Model) -> bool:
    """Decide whether a model beside a random torque has what is there, beyond one that the sensor's floor explains.

    A torque was learned; or there is more than a lag, which may be of the recording; or that takes away of the gap, or
    of what lasts of it, or is longer than rows are late.
    """
    added = set(model.effects) - set(plain.effects)
    more = {name for name in added if name not in LAGS or _is_longer_than_rows_are_late(model, name)}
    shrinks = model.held.gap < thresholds.SHRINKING_GAP * plain.held.gap
    shrinks = shrinks or model.lasting.gap < thresholds.SHRINKING_LASTING_GAP * plain.lasting.gap
    return model.errors.rms_voltage > 0.0 or shrinks or bool(more)


def _is_longer_than_rows_are_late(model: Model, lag: str) -> bool:
    estimate = model.estimate
    seconds = estimate.parameters.value(EFFECT_BY_NAME[lag].parameters[0].name)
    return seconds > thresholds.LATE_ROW * estimate.problem.sample_period


def likelihood_threshold() -> float:
    """Compute what a log likelihood ratio has to exceed, by Markov's inequality for all effects together."""
    return log(len(EFFECT_BY_NAME) / thresholds.FALSE_ALARM_RATE)


def pair_threshold() -> float:
    """Compute what the log likelihood ratio of two effects together has to exceed: the same, for all pairs together."""
    return log(comb(len(EFFECT_BY_NAME), 2) / thresholds.FALSE_ALARM_RATE)


def is_same_motion(one: Model, other: Model) -> bool:
    """Decide whether two models move alike where it counts: a load from the first instant on is a constant load.

    Whatever their likelihoods, which go with the errors that were learned of each, too.
    """
    if one.held.residuals.shape != other.held.residuals.shape:
        return False
    apart = float(other.held.weight @ (one.held.residuals - other.held.residuals) ** 2)
    return apart < (thresholds.SAME_MOTION * other.floor) ** 2
