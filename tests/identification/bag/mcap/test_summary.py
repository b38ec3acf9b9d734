"""The index at the end of a file is believed where its checksum fits."""

from io import BytesIO
from pathlib import Path

import pytest
from motor_bags import SAMPLES, START, write_bag

from motor_identification.bag.mcap.summary import Summary, read_summary


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    bag = write_bag(tmp_path_factory.mktemp("bag") / "bag", SAMPLES[:400], chunk=100)
    return next(Path(bag).glob("*.mcap")).read_bytes()


def test_topics_counts_times_and_chunks(whole: bytes) -> None:
    summary = read_summary(BytesIO(whole), len(whole))
    assert summary is not None and len(summary.chunks) >= 4
    contents = summary.contents()
    assert contents is not None and contents.message_count == 401
    assert {topic.name: topic.message_count for topic in contents.topics} == {"/motor/info": 1, "/motor/speed": 400}
    assert contents.span is not None and contents.span.first == START
    begins = sorted(chunk.chunk_start_offset for chunk in summary.chunks)
    assert [summary.next_chunk(0), summary.next_chunk(begins[0]), summary.next_chunk(begins[-1])] == [
        *begins[:2],
        None,
    ]


def test_no_index_a_cut_one_and_a_damaged_one_are_none(whole: bytes) -> None:
    for size in (0, 8, 100, len(whole) - 1, len(whole) - 40):
        assert read_summary(BytesIO(whole[:size]), size) is None
    for offset in range(9, 60):  # back from the footer: CRC, places, and the summary itself
        damaged = bytearray(whole)
        damaged[-offset] ^= 1
        assert read_summary(BytesIO(damaged), len(damaged)) is None, offset
    assert Summary().contents() is None and Summary().next_chunk(0) is None
