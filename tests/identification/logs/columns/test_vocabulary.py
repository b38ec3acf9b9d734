"""The tables of words and units."""

from motor_identification.logs.columns.vocabulary import SIDES, UNIT_BY_SPELLING, UNITS, WORDS, Quantity
from motor_identification.logs.form import TIME_UNITS, Kind
from motor_identification.logs.form import UNITS as FORM_UNITS


def test_every_spelling_is_of_a_unit_and_every_unit_can_be_spelt() -> None:
    assert set(UNIT_BY_SPELLING.values()) == set(UNITS)
    assert all(spelling == spelling.lower() and " " not in spelling for spelling in UNIT_BY_SPELLING)


def test_units_of_motion_are_those_of_the_form_and_as_large() -> None:
    for kind in Kind:
        for unit, size in FORM_UNITS[kind].items():
            assert UNITS[unit][1] == size
    for unit, size in TIME_UNITS.items():
        assert UNITS[unit] == (Quantity.TIME, float(size))


def test_no_word_is_of_two_quantities() -> None:
    words = [word for row in WORDS.values() for word in row]
    assert len(words) == len(set(words)) > 140 and not set(SIDES) & set(words) - {"r"}
