"""Reads single fields of any message, by the definitions that a bag embeds: `/joint_states:velocity[left_wheel]`."""

from motor_identification.bag.fields.path import FieldPath, parse_path
from motor_identification.bag.fields.series import Sampled, Series, collect_fields, read_fields, sample_topics
from motor_identification.bag.fields.values import list_fields, read_value

__all__ = [
    "FieldPath",
    "Sampled",
    "Series",
    "collect_fields",
    "list_fields",
    "parse_path",
    "read_fields",
    "read_value",
    "sample_topics",
]
