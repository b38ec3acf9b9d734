"""QoS profiles between rclpy and bags, both ways, and between publishers and those who have to fit them."""

from collections.abc import Iterable

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from motor_identification.bag import Qos

DEPTH = 1000  # of a subscription that must not lose a message while the disk is slow
_LARGEST_DEPTH = 10_000  # whatever a bag says: the middleware takes memory for it
_PLAYED_DEPTH = 100  # of a publisher whose recorded depth is unknown: DDS does not tell it


def offered(*profiles: QoSProfile) -> tuple[Qos, ...]:
    """Return what publishers offer, in the words of a bag; each different offer once."""
    described = (
        Qos(
            reliability=profile.reliability.short_key,
            durability=profile.durability.short_key,
            history=profile.history.short_key,
            depth=profile.depth,
        )
        for profile in profiles
    )
    return tuple(dict.fromkeys(described))


def to_hear(publishers: Iterable[QoSProfile]) -> QoSProfile:
    """Return a subscription that connects to all of these publishers, and asks for as much as they all offer."""
    profiles = list(publishers)
    reliable = all(profile.reliability == ReliabilityPolicy.RELIABLE for profile in profiles)
    latched = all(profile.durability == DurabilityPolicy.TRANSIENT_LOCAL for profile in profiles)
    return _profile(reliable, latched, DEPTH)


def to_play(recorded: tuple[Qos, ...]) -> QoSProfile:
    """Return a publisher that every subscriber of the recorded publishers connects to."""
    best_effort = bool(recorded) and all(profile.reliability == "best_effort" for profile in recorded)
    latched = any(profile.durability == "transient_local" for profile in recorded)
    known = [profile.depth for profile in recorded if profile.history == "keep_last" and profile.depth > 0]
    return _profile(not best_effort, latched, min(max(known, default=_PLAYED_DEPTH), _LARGEST_DEPTH))


def _profile(reliable: bool, latched: bool, depth: int) -> QoSProfile:
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
