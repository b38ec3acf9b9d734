"""What stands in `metadata.yaml`, in version 9 of rosbag2 (Jazzy)."""

import os
from collections.abc import Mapping
from itertools import islice
from pathlib import Path
from typing import Any

import yaml

from motor_identification.bag.contents import Contents, Span
from motor_identification.bag.topic import Qos, Topic
from motor_model import yaml_file
from motor_model.errors import MotorError
from motor_model.printable import escape
from motor_model.regular_file import write_text

VERSION = 9
FILE_NAME = "metadata.yaml"
KEY = "rosbag2_bagfile_information"  # that everything stands under
IMPORT, CAUTION_KEY = "import", "caution_"  # under custom_data: what an import said of the log, import.caution_1
MOST_CAUTIONS, LONGEST_CAUTION = 10, 500  # that are believed of a file which anybody may have written


def bag_metadata(files: Mapping[str, Contents], storage: str) -> dict[str, Any]:
    """Make the content for a bag of these files, by name and in their order; `storage` is `mcap` or `sqlite3`."""
    whole = Contents()
    for contents in files.values():
        whole = whole.joined(contents)
    return {
        "version": VERSION,
        "storage_identifier": storage,
        **_times(whole.span),
        "message_count": whole.message_count,
        "topics_with_message_count": [
            {"topic_metadata": _topic_metadata(topic), "message_count": topic.message_count} for topic in whole.topics
        ],
        "compression_format": "",  # the chunks inside the MCAP are compressed, which rosbag2 does not count
        "compression_mode": "",
        "relative_file_paths": list(files),
        "files": [
            {"path": name, **_times(contents.span), "message_count": contents.message_count}
            for name, contents in files.items()
        ],
        "custom_data": dict(whole.custom_data) or None,
        "ros_distro": os.environ.get("ROS_DISTRO", "jazzy"),
    }


def write_metadata(bag: Path, metadata: dict[str, Any]) -> None:
    """Write the directory's `metadata.yaml`.

    Raises:
        OSError: it cannot be written.
    """
    write_text(bag / FILE_NAME, yaml_text({KEY: metadata}))


def read_metadata(bag: Path) -> dict[str, Any]:
    """Read what `metadata.yaml` says; empty where it is missing or damaged."""
    try:
        return dict(yaml_file.read(bag / FILE_NAME)[KEY])
    except (OSError, MotorError, KeyError, TypeError, ValueError):
        return {}


def read_cautions(bag: Path) -> tuple[str, ...]:
    """Read what its import said that results of this bag have to be read with; empty where nobody noted any."""
    noted = read_metadata(bag).get("custom_data")
    if not isinstance(noted, dict):
        return ()
    begins = f"{IMPORT}.{CAUTION_KEY}"
    told = (value for key, value in noted.items() if isinstance(value, str) and str(key).startswith(begins))
    return tuple(f"The import cautions: {escape(text, LONGEST_CAUTION)}" for text in islice(told, MOST_CAUTIONS))


def profiles_text(profiles: tuple[Qos, ...]) -> str:
    """Profiles as the text in the metadata of an MCAP channel: a list, as rosbag2 writes it, empty or not."""
    return yaml_text([profile.entry() for profile in profiles]).strip()


def yaml_text(value: Any) -> str:
    """YAML that the C++ reader of rosbag2 takes."""
    return str(yaml.dump(value, Dumper=_WithoutAnchors, sort_keys=False))


class _WithoutAnchors(yaml.SafeDumper):
    """Writes a value out each time that it occurs."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _times(span: Span | None) -> dict[str, Any]:
    first, last = (span.first, span.last) if span else (0, 0)
    return {"starting_time": {"nanoseconds_since_epoch": first}, "duration": {"nanoseconds": last - first}}


def _topic_metadata(topic: Topic) -> dict[str, Any]:
    return {
        "name": topic.name,
        "type": topic.type_name,
        "serialization_format": "cdr",
        "offered_qos_profiles": [profile.entry() for profile in topic.qos],
        "type_description_hash": topic.type_hash,
    }
