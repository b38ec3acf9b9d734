#!/usr/bin/env bash
# Resolve the .in files again, for all supported Python versions at once. Needs `pip install uv`.
set -euo pipefail
cd "$(dirname "$0")"
for set in everything beside_ros; do
  uv pip compile --universal --python-version 3.10 --no-annotate --no-header --quiet "$set.in" |
    grep -v "sys_platform == 'win32'" >"$set.lock"
done
# The distribution's own packages stay: only what it lacks is pinned there.
sed -i -E '/^(numpy|scipy|matplotlib|PyYAML|pyyaml|tqdm)==/Id' beside_ros.lock
