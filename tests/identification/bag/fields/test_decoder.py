"""Messages by the definition in the bag."""

import foreign_bags
import numpy as np
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from motor_identification.bag.fields.decoder import Garbled, make_decoder
from motor_identification.bag.topic import Topic
from motor_model.errors import RecordingError


def test_a_type_that_is_not_installed_by_the_bags_definition() -> None:
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg("float64 x\nint8[] y\n", "some_msgs/msg/Thing"))
    data = store.serialize_cdr(
        store.types["some_msgs/msg/Thing"](2.5, np.array([1, 2], np.int8)), "some_msgs/msg/Thing"
    )
    decode = make_decoder(Topic("/thing", "some_msgs/msg/Thing", "float64 x\nint8[] y\n"))
    assert decode(bytes(data)).x == 2.5
    for broken in (b"", b"\0\1\0\0", bytes(data)[:9], b"\0\1\0\0" + b"\xff" * 20):
        with pytest.raises(Garbled):
            decode(broken)


def test_common_types_without_a_definition_and_others_with_none() -> None:
    assert make_decoder(Topic("/a", "sensor_msgs/msg/JointState"))
    for name in (foreign_bags.DRIVER, "", "no_msgs/msg/Thing"):
        with pytest.raises(RecordingError, match="has no definition of .*, and it is not installed: record it as MCAP"):
            make_decoder(Topic("/a", name))


@pytest.mark.parametrize("definition", ["no field at all!", "Missing field\n", "float64\n"])
def test_a_definition_that_is_none(definition: str) -> None:
    with pytest.raises(RecordingError, match="cannot be understood"):
        make_decoder(Topic("/a", "some_msgs/msg/Other", definition))(b"\0\1\0\0" + bytes(40))
