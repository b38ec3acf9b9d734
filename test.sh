#!/usr/bin/env bash
# All tests; arguments go to pytest, for example ./test.sh -k swarm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
./setup.sh
set +u
source env.sh
set -u
pytest() { .venv/bin/python -m pytest "$@"; }
if [ $# -gt 0 ]; then
  pytest "$@"
  exit
fi
pure=(tests/model tests/identification tests/control tests/plant_checks) # no nodes, no clock: on two cores at once
status=0
pytest -n 2 "${pure[@]}" || status=$?
pytest "${pure[@]/#/--ignore=}" || status=$?
exit $status
