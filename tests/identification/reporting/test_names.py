"""Effects by the names that people use, and lists of them."""

from motor_identification.reporting.names import capitalize, effect_name, join_effects, join_names
from motor_model.effects import EFFECTS


def test_names_are_those_of_people() -> None:
    assert effect_name("coulomb_friction") == "Coulomb friction" and effect_name("dead_zone") == "dead zone"
    assert capitalize("dead zone of 2 V") == "Dead zone of 2 V" and capitalize("") == ""


def test_names_are_joined_as_a_sentence_lists_them() -> None:
    lists = ((), ("a",), ("a", "b"), ("a", "b", "c"))
    assert [join_names(names) for names in lists] == ["", "a", "a and b", "a, b and c"]
    assert join_names(("a", "b", "c"), "or") == "a, b or c"


def test_six_effects_are_named_and_the_others_counted() -> None:
    names = [effect.name for effect in EFFECTS]
    assert join_effects(names[:6]).count(",") == 4 and " or " in join_effects(names[:6])
    assert join_effects(names[:7]).endswith(" and 1 other")
    assert join_effects(names).endswith(f" and {len(EFFECTS) - 6} others")
