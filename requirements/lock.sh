#!/usr/bin/env bash
# Resolve the .in files again, for all supported Python versions at once; pins that still fit stay. Needs `pip install uv`.
# With --upgrade, everything moves to its newest version.
set -euo pipefail
cd "$(dirname "$0")"
drop() { # the packages whose line matches $1, with their hashes, from standard input
  awk -v pattern="$1" '/^[^ ]/ { drop = ($0 ~ pattern) } !drop'
}
for set in everything beside_ros; do
  uv pip compile --universal --python-version 3.10 --no-annotate --no-header --quiet --generate-hashes "$@" \
    --output-file "$set.lock" "$set.in" >/dev/null
  drop "sys_platform == 'win32'" <"$set.lock" >"$set.new"
  mv "$set.new" "$set.lock"
done
# What colcon asks for to run tests with, and nobody does: Numba imports coverage where it is, 60 ms of every start.
drop '^(coverage|pytest-cov|pytest-repeat|pytest-rerunfailures)==' <everything.lock >everything.new
mv everything.new everything.lock
# The distribution's own packages stay, with what they need: only what it lacks is pinned there.
drop '^(numpy|scipy|matplotlib|pyyaml|tqdm|contourpy|cycler|fonttools|kiwisolver|pillow|pyparsing|python-dateutil|six|tzdata)==' \
  <beside_ros.lock >beside_ros.new
mv beside_ros.new beside_ros.lock
