"""What stands in `metadata.yaml`, in version 9 of rosbag2 (Jazzy)."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import yaml

from motor_identification.bag.topic import Qos, Topic

VERSION = 9


@dataclass(frozen=True, slots=True)
class Span:
    """The earliest and the latest log time [ns since 1970]."""

    first: int
    last: int

    def including(self, log_time: int) -> "Span":
        """The span stretched to another message."""
        return Span(min(self.first, log_time), max(self.last, log_time))


def bag_metadata(topics: Mapping[Topic, str], counts: Mapping[str, int], span: Span, file_name: str) -> dict[str, Any]:
    """The content for a bag of one MCAP file; `topics` maps each topic to its type hash."""
    total = sum(counts.values())
    times = {
        "starting_time": {"nanoseconds_since_epoch": span.first},
        "duration": {"nanoseconds": span.last - span.first},
    }
    return {
        "version": VERSION,
        "storage_identifier": "mcap",
        **times,
        "message_count": total,
        "topics_with_message_count": [
            {"topic_metadata": _topic_metadata(topic, type_hash), "message_count": counts.get(topic.name, 0)}
            for topic, type_hash in topics.items()
        ],
        "compression_format": "",  # the chunks inside the MCAP are compressed, which rosbag2 does not count
        "compression_mode": "",
        "relative_file_paths": [file_name],
        "files": [{"path": file_name, **times, "message_count": total}],
        "custom_data": None,
        "ros_distro": os.environ.get("ROS_DISTRO", "jazzy"),
    }


def profiles_text(profiles: tuple[Qos, ...]) -> str:
    """Profiles as the text that stands in the metadata of an MCAP channel."""
    return yaml_text([profile.entry() for profile in profiles]).strip() if profiles else ""


def yaml_text(value: Any) -> str:
    """YAML that the C++ reader of rosbag2 takes."""
    return str(yaml.dump(value, Dumper=_WithoutAnchors, sort_keys=False))


class _WithoutAnchors(yaml.SafeDumper):
    """Writes a value out each time that it occurs."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _topic_metadata(topic: Topic, type_hash: str) -> dict[str, Any]:
    return {
        "name": topic.name,
        "type": topic.type_name,
        "serialization_format": "cdr",
        "offered_qos_profiles": [profile.entry() for profile in topic.qos],
        "type_description_hash": type_hash,
    }
