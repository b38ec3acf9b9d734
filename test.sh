#!/usr/bin/env bash
# The tests but for the slow ones; with --all, those too. Other arguments go to pytest, for example ./test.sh -k swarm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
./setup.sh
set +u
source env.sh
set -u
unset PYTHONDONTWRITEBYTECODE # else every worker and every process of the tests compiles all sources anew
pytest() { .venv/bin/python -m pytest "$@"; }
tier=" and not slow"
if [ "${1:-}" = --all ]; then
  tier=""
  shift
fi
if [ $# -gt 0 ]; then
  pytest "$@"
  exit
fi
# Once, not by every worker of a fresh clone; the plant beside what pytest does first.
.venv/bin/python -m compileall -q -j 0 tests motor_*/motor_* ros2_stand_in || true
PYTHONPATH=tests/support:${PYTHONPATH:-} .venv/bin/python -m plant &
status=0
# Assertions are not rewritten to say more, which takes every worker of a fresh clone 6 s: what fails is run again.
run() { pytest --assert=plain "$@" || { local code=$?; [ $code -eq 1 ] || exit $code; status=1; }; } # 1: some test failed
cores=$(nproc)
workers=$((cores > 1 ? 4 : 2)) # more than cores, for many tests wait; each has ROS domains of its own
run --cache-clear -n "$workers" --dist worksteal -m "not on_time$tier"
# These measure times: nothing else runs, and they wait for most of theirs; only their files are collected.
run -n 3 --dist worksteal -m "on_time$tier" $(grep -rl --include='*.py' '^@pytest.mark.on_time$' tests)
failed=$(grep -sc '": true' .pytest_cache/v/cache/lastfailed || true) # in both runs
if ((status == 1 && failed > 0 && failed <= 5)); then
  echo "[test] $failed failed, and are run once more, alone: on a busy machine a live test may fail, a mistake fails twice."
  status=0
  run --assert=rewrite --last-failed
elif ((status == 1)); then
  echo "[test] './test.sh --last-failed' runs what failed once more, and says what was compared."
fi
exit $status
