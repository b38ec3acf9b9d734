"""A diagnosis in words: what was missing, what that explains, what is left, and what to do next."""

from collections.abc import Sequence
from math import inf

from motor_identification.diagnosis.candidate_model import find_lasting_interval
from motor_identification.diagnosis.evidence.command_evidence import (
    Ignored,
    find_falling,
    find_ignored,
    goes_with_sweep,
)
from motor_identification.diagnosis.result import Diagnosis, Finding, Imitated, Verdict, list_vague
from motor_identification.diagnosis.thresholds import EXPLAINED_GAP, LEAST_TURNS, SURE_SIZE
from motor_identification.discrepancy.missing_torque import describe_torque, estimate_missing_torque
from motor_identification.discrepancy.region_text import describe_error
from motor_identification.measurement.intervals import count_turns
from motor_identification.reporting.caveats_text import (
    describe_cut,
    describe_disturbance,
    describe_falling,
    describe_few_values,
    describe_gains,
    describe_likes,
    describe_stopped,
    describe_supply,
)
from motor_identification.reporting.diagnosis_table import format_parameters
from motor_identification.reporting.names import capitalize, effect_name, join_effects, join_names
from motor_identification.reporting.numbers import describe_change, format_ratio, format_unit
from motor_model.effects import EFFECT_BY_NAME

GAP, FITTED_GAP = "validation RMS error (gap)", "RMS error (gap)"
TOO_SHORT = "The recording is too short to keep a part of it for validation: record more motion."
OUT_OF_TIME = "The time limit of {:g} s ended the search: what follows is the best so far; allow more with --budget."
NO_MOTOR = (
    "But kv ended at the limit of what is searched: no motor moves like this by such a voltage; check the columns of "
    "voltage and motion, and their units."
)
SEEN = (
    "The command swings too seldom to hold any of it out: this gap is of the motion that was fitted; --validate BAG "
    "tests it on another."
)
OF_SENSOR = "the speeds were smoothed or late before they were logged"
DESCRIBE_SENSOR = (
    "Log the encoder's counts, or say how the speeds were made (--speed-window and --speed-lag of an import)."
)
UNPREDICTED = (
    "Nothing that was measured predicts what is left, and no random torque makes it: noise of the sensor, such as "
    "edges that are missed, or something that was not recorded, may."
)
SCALED_BY_DISC = (
    " In a part of a turn that makes the speeds larger or smaller throughout: kv and ka may be off by more than their "
    "errors. Let the shaft turn round more than once."
)
UNMODELLED = "Check for a load, a supply or a sensor that was not recorded; the report shows the residual torque."

UNDRIVEN = (
    "{uri}: the motor turns at {speed:.3g} rad/s in the first {duration:.3g} s, in which the voltage is 0, and keeps "
    "that speed: nothing drives a motor at 0 V. What was logged as its voltage may be a mark, the change of a voltage, "
    "or another motor's: log what drives it. No effect was looked for."
)
SWEPT = "Something is missing that a sweep does not tell, in which what goes with the frequency goes with the time: {}."

STRUCTURE_NAMES = {
    "speed": "speed",
    "voltage": "commanded voltage",
    "drive": "drive (voltage less back-EMF)",
    "speed_voltage": "speed and the voltage together",
    "angle": "shaft angle",
    "time": "time within the recording",
    "spectrum": "time (a periodic load or supply)",
    "past": "motion and the command just before",
}


def summarize_diagnosis(diagnosis: Diagnosis) -> str:
    """Say what was missing, what it explains and what is left, in one to three sentences, then what to do."""
    if diagnosis.undriven is not None:
        return UNDRIVEN.format(**vars(diagnosis.undriven))
    seen = SEEN if diagnosis.after.seen else ""
    told = (
        describe_gains(diagnosis),
        describe_likes(diagnosis),
        describe_cut(diagnosis),
        describe_supply(diagnosis),
        seen,
        _next_step(diagnosis),
    )
    parts = (describe_stopped(diagnosis), describe_falling(diagnosis), _SUMMARIES[diagnosis.verdict](diagnosis), *told)
    return " ".join(part for part in parts if part)


def _describe_gap_reduction(diagnosis: Diagnosis) -> str:
    """Say by how much the gap falls, beside the noise floor; beside a random torque it may rise."""
    change = describe_change(diagnosis.gap_before, diagnosis.gap_after)
    text = f"the {_name_gap(diagnosis)} {change} rad/s ({_compare_with_floor(diagnosis)})"
    if diagnosis.gap_after > diagnosis.gap_before:
        return f"{text}: most of it is of a random torque, beside which the motion is likelier"
    if diagnosis.gap_before > EXPLAINED_GAP * diagnosis.noise_floor:
        return text
    length = find_lasting_interval(diagnosis.before)
    lasting = describe_change(*(held.joined(length).gap for held in (diagnosis.before, diagnosis.after)))
    return f"{text}; averaged over {length:.2g} s, which smooths the encoder's steps, it {lasting} rad/s"


def _name_gap(diagnosis: Diagnosis) -> str:
    return FITTED_GAP if diagnosis.after.seen else GAP


def _is_at_floor(diagnosis: Diagnosis) -> bool:
    """Decide whether the noise leaves as much as is left."""
    return diagnosis.gap_after <= EXPLAINED_GAP * diagnosis.noise_floor


def _compare_with_floor(diagnosis: Diagnosis) -> str:
    """Write the final gap as a multiple of the noise floor."""
    floor = diagnosis.noise_floor
    if floor <= 0.0:
        return "the noise level is unknown"
    return f"{format_ratio(diagnosis.gap_after / floor)} × the noise floor of {floor:.3g} rad/s"


def _describe_gap(diagnosis: Diagnosis) -> str:
    return f"the {_name_gap(diagnosis)} is {diagnosis.gap_after:.3g} rad/s, {_compare_with_floor(diagnosis)}"


def _describe_found(findings: Sequence[Finding], sure: bool = True) -> str:
    """Say which effects were missing."""
    each = [f"{effect_name(one.effect)} ({format_parameters(one)})" for one in findings]
    were = " was missing" if len(each) == 1 else " were missing"
    return capitalize(join_names(each) + (were if sure else " may be missing"))


def _list_named(findings: Sequence[Finding]) -> list[Finding]:
    """List the findings that are named: not one of no size that is there because another cannot be without it."""
    implied = {EFFECT_BY_NAME[one.effect].implies for one in findings}
    return [one for one in findings if one.effect not in implied or not _is_of_no_size(one)]


def _is_of_no_size(finding: Finding) -> bool:
    """Decide whether a finding's first parameter is none as far as its standard error goes."""
    value, error = next(iter(finding.parameters.values()), (inf, 0.0))
    return abs(value - EFFECT_BY_NAME[finding.effect].parameters[0].off) < SURE_SIZE * error


def _explained(diagnosis: Diagnosis) -> str:
    model = "it" if len(diagnosis.findings) == 1 else "them"
    text = f"{_describe_found(_list_named(diagnosis.findings))}. With {model}, {_describe_gap_reduction(diagnosis)}."
    rest = (describe_few_values(diagnosis), describe_disturbance(diagnosis))
    parts = (text, *rest, _describe_undetermined(diagnosis), _describe_untestable(diagnosis))
    return " ".join(part for part in parts if part)


def _nothing_missing(diagnosis: Diagnosis) -> str:
    text = f"Nothing is missing: {_describe_gap(diagnosis)}."
    return " ".join(part for part in (text, describe_few_values(diagnosis), describe_disturbance(diagnosis)) if part)


def _describe_structure(diagnosis: Diagnosis) -> str:
    """Say which variable predicts most of what is left, or what would leave it; empty where none does."""
    certain = [one for one in diagnosis.structure if one.certain]
    if not certain:
        return ""
    most, share = certain[0], 100.0 * certain[0].most
    if most.cause:
        return f"Of what is left, {share:.0f} % is what {most.cause} would leave."
    return f"Of what is left, {share:.0f} % can be predicted from the {STRUCTURE_NAMES[most.variable]}."


def _describe_untestable(diagnosis: Diagnosis) -> str:
    if not diagnosis.undetectable:
        return ""
    text = f"This recording could not show {join_effects(diagnosis.undetectable)}."
    return f"{text} {_describe_imitated(diagnosis.imitated)}" if diagnosis.imitated else text


def _describe_imitated(imitated: Imitated, without: str = "those") -> str:
    """Say what kv would be beside an effect that it imitates, one of those that it is told without."""
    name, spec = join_effects([imitated.effect]), EFFECT_BY_NAME[imitated.effect].parameters[0]
    size = f"{spec.name} = {imitated.size:.2g} {format_unit(spec.name)}".rstrip()
    return f"kv and its ± hold without {without}: beside {name} ({size}), say, kv would be {imitated.kv:.3g} V·s/rad."


def _unexplained(diagnosis: Diagnosis) -> str:
    worst = capitalize(describe_error(diagnosis.after, diagnosis.slot_share))
    torque = describe_torque(estimate_missing_torque(diagnosis.after))
    left = describe_few_values(diagnosis) or _describe_structure(diagnosis)  # of few values, what curves find is those
    rest = " ".join(part for part in (left, f"{worst}.", torque, UNMODELLED) if part)
    if diagnosis.findings:
        found = f"{_describe_findings(diagnosis)} {capitalize(_describe_gap_reduction(diagnosis))}."
        return f"{found} Another effect, which is not in the table, is missing. {rest}"
    text = f"An effect that is not in the table is missing: {_describe_gap(diagnosis)}."
    return " ".join(part for part in (text, _describe_nearest(diagnosis), rest) if part)


def _describe_nearest(diagnosis: Diagnosis) -> str:
    """Say which effects come nearest where nothing of the table explains what is missing; empty where none does."""
    nearest = diagnosis.nearest
    if nearest is None:
        return ""
    one = len(nearest.effects) == 1
    names = capitalize(join_names([effect_name(name) for name in nearest.effects]))
    return (
        f"{names} {'comes' if one else 'come'} nearest: with {'it' if one else 'them'} the gap would be "
        f"{nearest.gap:.3g} rad/s, but {'it' if one else 'they'} may only stand in for what is missing."
    )


def _describe_findings(diagnosis: Diagnosis) -> str:
    """Say what is missing, what of it has no determined size, and what this recording cannot distinguish."""
    named = _list_named(diagnosis.findings)
    clear = [one for one in named if not (one.ambiguous_with or one.sensor_may_lag)]
    vague = list_vague(clear)
    sized = [one for one in clear if one not in vague]
    unsure = diagnosis.is_of_no_motor or diagnosis.time_limit or find_falling(diagnosis.after) is not None
    sure = diagnosis.after.confirms and not unsure
    open_ = bool(diagnosis.undetermined) or goes_with_sweep(diagnosis.structure, diagnosis.after)
    sure = sure and not (open_ and diagnosis.leaves_more)  # beside that they may stand in
    parts = [f"{_describe_found(sized, sure)}."] if sized else []
    parts += [f"{_describe_found(vague, sure=False)}; this recording does not tell how much."] if vague else []
    missing = "is missing" if sure else "may be missing"
    for one in named:
        if one.ambiguous_with or one.sensor_may_lag:
            names = join_names([effect_name(name) for name in (one.effect, *one.ambiguous_with)], "or")
            parts.append(f"{capitalize(names)} {missing}{_describe_rival_sensor(one)}.")
    if any(one.sensor_may_lag for one in diagnosis.findings):
        parts.append(DESCRIBE_SENSOR)
    return " ".join(parts)


def _describe_rival_sensor(one: Finding) -> str:
    """Say that what lags may be the sensor, with the size that it has as an effect, or that effects are alike."""
    if not one.sensor_may_lag:
        return "; this recording cannot distinguish them"
    size = format_parameters(one)
    return f" ({size}), or {OF_SENSOR}; this recording cannot distinguish them"


def _describe_undetermined(diagnosis: Diagnosis) -> str:
    """Say which effects something speaks for that has no size; empty where there is none."""
    if not diagnosis.undetermined:
        return ""
    names = join_effects(diagnosis.undetermined)
    what = f"{capitalize(names)} may be there, too" if diagnosis.findings else f"It may be {names}"
    unturned = count_turns(diagnosis.after.intervals, diagnosis.after.angles) < LEAST_TURNS
    scaled = unturned and any(EFFECT_BY_NAME[name].on_disc for name in diagnosis.undetermined)
    return f"{what}, but this recording does not tell how much.{SCALED_BY_DISC if scaled else ''}"


def _describe_ignored(ignored: Ignored) -> str:
    """Say that a motion has hardly to do with its command, and what to look at."""
    return (
        f"The motion hardly follows the command: a motor leaves {ignored.gap:.3g} rad/s (RMS) of it, where the speed "
        f"itself varies by {ignored.variation:.3g} rad/s. Check that the columns of voltage and motion are those of "
        "one motor, and that no rows are missing between them."
    )


def _undecided(diagnosis: Diagnosis) -> str:
    if diagnosis.findings:
        parts = [_describe_findings(diagnosis), f"{capitalize(_describe_gap_reduction(diagnosis))}."]
    else:
        parts = [_describe_no_finding(diagnosis)]
    follows = bool(diagnosis.findings) or find_ignored(diagnosis.after) is None
    if follows and not diagnosis.undetermined and diagnosis.is_unpredicted:
        parts.append(UNPREDICTED)
    if diagnosis.is_of_no_motor and follows:  # else the same was said, and what to check
        parts.append(NO_MOTOR)
    parts += [describe_few_values(diagnosis), describe_disturbance(diagnosis)]
    if diagnosis.time_limit:
        parts.insert(0, OUT_OF_TIME.format(diagnosis.time_limit))
    if diagnosis.undetermined:
        parts.append(_describe_undetermined(diagnosis))
        parts.append("" if diagnosis.findings else _describe_nearest(diagnosis))
    if diagnosis.undetectable and not any(one.ambiguous_with for one in diagnosis.findings):
        parts.append(_describe_untestable(diagnosis))
    elif diagnosis.imitated:
        parts.append(_describe_imitated(diagnosis.imitated, "what this recording could not show"))
    return " ".join(part for part in parts if part)


def _describe_no_finding(diagnosis: Diagnosis) -> str:
    """Say why nothing was found."""
    if not diagnosis.after.counted.any():
        return TOO_SHORT
    if diagnosis.time_limit:
        return f"No effect was found until then: {_describe_gap(diagnosis)}."
    if diagnosis.undetermined:
        missing = "may be" if _is_at_floor(diagnosis) else "is"  # a random torque, or gains, may be all of it
        return f"Something {missing} missing that this recording does not determine: {_describe_gap(diagnosis)}."
    if not diagnosis.after.confirms and not _is_at_floor(diagnosis):
        text = f"Something may be missing that one response does not tell: {_describe_gap(diagnosis)}."
        return " ".join(filter(None, (text, _describe_nearest(diagnosis))))
    ignored = find_ignored(diagnosis.after)
    if ignored is not None:
        return _describe_ignored(ignored)
    if diagnosis.leaves_more and goes_with_sweep(diagnosis.structure, diagnosis.after):
        nearest = _describe_nearest(diagnosis)
        return " ".join(filter(None, (SWEPT.format(_describe_gap(diagnosis)), nearest, _describe_structure(diagnosis))))
    if diagnosis.nearest is not None:
        text = f"Something may be missing that this recording does not tell from chance: {_describe_gap(diagnosis)}."
        return f"{text} {_describe_nearest(diagnosis)}"
    if diagnosis.is_unpredicted:
        return f"More is left than the sensor leaves by what is known of it: {_describe_gap(diagnosis)}."
    if diagnosis.disturbance is not None and diagnosis.gap_after > EXPLAINED_GAP * diagnosis.sensor_floor:
        return f"Nothing can be told apart from a random torque in this recording: {_describe_gap(diagnosis)}."
    return f"Nothing is missing that this recording could show: {_describe_gap(diagnosis)}."


def _next_step(diagnosis: Diagnosis) -> str:
    profile = diagnosis.suggested_experiment
    return f"Record the profile '{profile}' and diagnose both recordings together." if profile else ""


_SUMMARIES = {
    Verdict.EXPLAINED: _explained,
    Verdict.NOTHING_MISSING: _nothing_missing,
    Verdict.UNEXPLAINED: _unexplained,
    Verdict.UNDECIDED: _undecided,
}
