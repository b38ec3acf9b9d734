"""When a motor may begin to turn: with what the user asks for after the board is there, not with what flowed before."""

from driver_rig import MakeRig, Rig, problem


def test_starts_off_where_the_user_wants_that(make_rig: MakeRig) -> None:
    rig = make_rig(enabled=False)
    rig.voltage = 6.0
    assert rig.enable() == "There is no link to the board yet."
    rig.plug()
    rig.run(500)
    assert rig.pins == 0.0 and len(rig.readings) > 50
    assert rig.enable() == ""
    rig.until(lambda: rig.pins == 6.0, 30)
    rig.enable(False)
    assert rig.until(lambda: rig.pins == 0.0, 30) < 20.0


def test_a_successor_does_not_drive_with_what_flowed_before(running: Rig) -> None:
    """Killed and started again under a voltage that keeps coming: 0 V until the user begins, or enables."""
    running.alive = False
    successor = Rig(emulator=running.emulator, cautious=False)
    successor.voltage, successor._said = 6.0, 500  # so many he has sent already
    successor.plug()
    successor.run(3000)
    assert successor.pins == 0.0 and successor.stops == [] and len(successor.readings) > 400
    assert "6 V was already being sent on motor/voltage when the plant came up" in problem(successor)
    assert successor.enable() == ""
    successor.until(lambda: successor.pins == 6.0, 30)
    assert problem(successor) == ""


def test_a_board_that_is_plugged_in_under_a_flowing_voltage_waits(make_rig: MakeRig) -> None:
    rig = make_rig(cautious=False)
    rig.voltage = 6.0
    rig.run(500)
    rig.plug()
    rig.run(3000)
    assert rig.pins == 0.0
    rig.voltage = 0.0
    rig.run(20)
    rig.voltage = 6.0
    rig.until(lambda: rig.pins == 6.0, 30)


def test_a_new_sender_drives_at_once(make_rig: MakeRig) -> None:
    rig = make_rig(cautious=False)
    rig.plug()
    rig.run(500)
    rig.voltage = 6.0
    rig.until(lambda: rig.pins == 6.0, 30)
