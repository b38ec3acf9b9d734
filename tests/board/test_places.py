"""Where the package's files are."""

from motor_board.places import share


def test_the_share_folder_has_what_is_built_and_spoken() -> None:
    assert {"firmware", "emulator", "protocol"} <= {path.name for path in share().iterdir()}
    assert share() is share()
