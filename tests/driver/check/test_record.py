"""What a run writes down: each finding once, and whether software makes up for all of them."""

from motor_driver.check.record import CURED, WRONG, Record


def test_a_finding_is_said_once_and_marked_by_whether_it_is_cured() -> None:
    record = Record()
    record.find("direction", "motor_swapped")
    record.find("direction", "motor_swapped")
    assert record.codes == ["motor_swapped"] and [row.mark for row in record.rows] == [CURED] and not record.wrong
    record.find("encoder", "b_missing")
    assert record.rows[-1].mark == WRONG and record.wrong
