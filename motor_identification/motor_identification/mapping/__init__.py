"""Reads bags of any robot: which fields of which messages are a motor's voltage and motion, kept in a mapping file."""

from motor_identification.mapping.mapped_recording import MappedReader, make_reader, read_mapped
from motor_identification.mapping.mapping import Mapping, Origin, load_mapping, mapping_text, parse_origin

__all__ = [
    "MappedReader",
    "Mapping",
    "Origin",
    "load_mapping",
    "make_reader",
    "mapping_text",
    "parse_origin",
    "read_mapped",
]
