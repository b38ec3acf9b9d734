"""Change fields of a frozen record, which a loop does several times at every sample.

`dataclasses.replace` reads every field and calls the constructor. A controller's state has some thirty of them, and
half of a loop's time went there; a record without slots is copied at once.
"""

from dataclasses import is_dataclass
from typing import TYPE_CHECKING, Any, TypeVar

__all__ = ["replace"]

if TYPE_CHECKING:  # to a type checker it is that function: names and types of the fields are checked
    from dataclasses import replace
else:
    Record = TypeVar("Record")
    _PLAIN = set()  # types that can be copied so

    def replace(record: Record, /, **changes: Any) -> Record:
        """Copy a frozen record with some fields changed; its type is a dataclass without slots and `__post_init__`.

        Raises:
            TypeError: it is of another type, or has no field of such a name.
        """
        kind = type(record)
        if kind not in _PLAIN:
            _check_type(kind)
        fields = record.__dict__ | changes
        if len(fields) != len(record.__dict__):
            raise TypeError(f"{kind.__name__} has no field {', '.join(sorted(changes.keys() - vars(record).keys()))}.")
        copy = object.__new__(kind)
        object.__setattr__(copy, "__dict__", fields)  # the record's own refuses to set anything
        return copy

    def _check_type(kind: type) -> None:
        """Check once that a type's records are nothing but their fields."""
        if not is_dataclass(kind) or hasattr(kind, "__slots__") or hasattr(kind, "__post_init__"):
            raise TypeError(f"{kind.__name__} is no plain dataclass: use dataclasses.replace.")
        _PLAIN.add(kind)
