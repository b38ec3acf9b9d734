#!/usr/bin/env bash
# The main job in one command: a motor recorded, identified by particle swarm and held at a speed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
./setup.sh
set +u
source env.sh
set -u
exec .venv/bin/python demo/demo.py
