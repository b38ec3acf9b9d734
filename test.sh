#!/usr/bin/env bash
# All tests; arguments go to pytest, for example ./test.sh -k swarm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
./setup.sh
set +u
source env.sh
set -u
unset PYTHONDONTWRITEBYTECODE # else every worker and every process of the tests compiles all sources anew
pytest() { .venv/bin/python -m pytest "$@"; }
if [ $# -gt 0 ]; then
  pytest "$@"
  exit
fi
status=0
cores=$(nproc)
workers=$((cores < 4 ? cores + 1 : 4)) # one more than cores, for many tests wait; each has ROS domains of its own
pytest -n "$workers" --dist worksteal -m "not on_time" || status=$?
pytest -n 2 -m on_time tests/{board,ros,ros2_stand_in,system} || status=$? # these measure times: nothing else runs
exit $status
