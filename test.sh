#!/usr/bin/env bash
# All tests; arguments go to pytest, for example ./test.sh -k swarm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
./setup.sh
set +u
source env.sh
set -u
exec .venv/bin/python -m pytest "$@"
