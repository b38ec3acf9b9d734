"""Quality of service: the real command's options, and what fits the publishers of a topic."""

import argparse
from collections.abc import Sequence

from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)
from rclpy.topic_endpoint_info import TopicEndpointInfo

from ros2_stand_in.arguments import positive_count

_POLICIES = {"history": HistoryPolicy, "reliability": ReliabilityPolicy, "durability": DurabilityPolicy}


def qos_arguments(parser: argparse.ArgumentParser, preset: str) -> None:
    """Add the options that choose a profile; `preset` is the one that the verb starts from."""
    parser.add_argument(
        "--qos-profile", choices=QoSPresetProfiles.short_keys(), help=f"profile to start from (default: {preset})"
    )
    parser.add_argument("--qos-depth", metavar="N", type=positive_count, help="length of the queue")
    for name, policy in _POLICIES.items():
        parser.add_argument(f"--qos-{name}", choices=policy.short_keys(), help=f"{name} instead of the profile's")
    parser.set_defaults(qos_preset=preset)


def asked_for(args: argparse.Namespace) -> QoSProfile | None:
    """The profile that the options ask for; None if there are none."""
    given = [getattr(args, f"qos_{name}") for name in (*_POLICIES, "depth", "profile")]
    return profile(args) if any(given) else None


def profile(args: argparse.Namespace) -> QoSProfile:
    """The verb's own profile, changed by the options."""
    chosen = _preset(args.qos_profile or args.qos_preset)
    for name, policy in _POLICIES.items():
        key = getattr(args, f"qos_{name}")
        if key:
            setattr(chosen, name, policy.get_from_short_key(key))
    if args.qos_depth:
        chosen.depth = args.qos_depth
    return chosen


def fitting(publishers: Sequence[TopicEndpointInfo], preset: str) -> QoSProfile:
    """A subscriber's profile that connects to all publishers and asks for as much as all of them offer."""
    chosen = _preset(preset)
    if not publishers:
        return chosen
    offered = [publisher.qos_profile for publisher in publishers]
    reliable = all(each.reliability == ReliabilityPolicy.RELIABLE for each in offered)
    latched = all(each.durability == DurabilityPolicy.TRANSIENT_LOCAL for each in offered)
    chosen.reliability = ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT
    chosen.durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
    return chosen


def _preset(name: str) -> QoSProfile:
    """A copy, because presets are shared."""
    preset = QoSPresetProfiles.get_from_short_key(name)
    return QoSProfile(
        history=preset.history, depth=preset.depth, reliability=preset.reliability, durability=preset.durability
    )
