"""Where the `ros2` launcher enters: finds the package beside this file, whatever the current directory is."""

import signal

heard = signal.getsignal(signal.SIGINT)
if heard is signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while nothing runs but imports, Ctrl-C ends it silently
signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})  # the launcher has held it back while Python started

import os  # noqa: E402
import sys  # noqa: E402
from pathlib import Path  # noqa: E402

# The workbench's root is on the path for this one import only: it holds folders named like the packages in them.
sys.path[0] = str(Path(__file__).resolve().parent.parent)
import ros2_stand_in  # noqa: E402, F401

del sys.path[0]

try:
    from ros2_stand_in.main import main

    signal.signal(signal.SIGINT, heard)
    status = main(sys.argv[1:])
except ModuleNotFoundError as error:
    sys.exit(f"{error.name} is not on the path: 'source env.sh' in the workbench's root, then try again.")
except KeyboardInterrupt:
    sys.exit(130)

os._exit(status)  # everything is closed and flushed; to unload the middleware takes 0.13 s more
