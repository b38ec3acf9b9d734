# Puts the workbench on the path of this bash: `source env.sh`.
if [ -z "${BASH_VERSION:-}" ]; then
  echo "env.sh is for bash: start bash, then 'source env.sh'." >&2
  return 1 2>/dev/null || exit 1
fi
_motor_root="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)"
if [ ! -x "$_motor_root/.venv/bin/python" ] || [ ! -f "$_motor_root/install/local_setup.bash" ]; then
  echo "The workbench is not built here yet: run $_motor_root/setup.sh, then source env.sh again." >&2
  unset _motor_root
  return 1 2>/dev/null || exit 1
fi

# Nothing leaves this machine, and no stranger's node moves a motor, unless you say so: export
# ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET before this (motor_ros/motor_ros/loopback.py says the same to programs).
export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}"
case "$ROS_AUTOMATIC_DISCOVERY_RANGE" in
  SUBNET | SYSTEM_DEFAULT)
    _motor_profile=quick_discovery.xml
    echo "ROS_AUTOMATIC_DISCOVERY_RANGE opens the network: everybody on it hears the motors and drives them; unset it to stay on this machine." >&2
    ;;
  *) _motor_profile=loopback.xml ;;
esac
case "${FASTRTPS_DEFAULT_PROFILES_FILE:-loopback.xml}" in
  loopback.xml | */loopback.xml | quick_discovery.xml | */quick_discovery.xml) ;;
  *)
    # Fast DDS would go on, open, without a file and with another program's
    if ! "$_motor_root/.venv/bin/python" -I -c '
import sys
sys.path[:0] = sys.argv[2:]
from motor_ros.loopback import is_profile
sys.exit(not is_profile(sys.argv[1]))' "$FASTRTPS_DEFAULT_PROFILES_FILE" "$_motor_root/motor_ros" "$_motor_root/motor_model"; then
      echo "FASTRTPS_DEFAULT_PROFILES_FILE is $FASTRTPS_DEFAULT_PROFILES_FILE, which cannot be read as a profile: the workbench's own $_motor_profile is used. Correct it, or unset it." >&2
      unset FASTRTPS_DEFAULT_PROFILES_FILE
    fi
    ;;
esac
case "${FASTRTPS_DEFAULT_PROFILES_FILE:-loopback.xml}" in
  loopback.xml | */loopback.xml | quick_discovery.xml | */quick_discovery.xml)
    export FASTRTPS_DEFAULT_PROFILES_FILE="$_motor_root/motor_ros/motor_ros/$_motor_profile"
    ;;
  *) echo "FASTRTPS_DEFAULT_PROFILES_FILE is your own: it decides who can reach the motors, the workbench's loopback.xml is not used." >&2 ;;
esac
case "$FASTRTPS_DEFAULT_PROFILES_FILE" in
  */loopback.xml)
    for _motor_name in ROS_STATIC_PEERS ROS_DISCOVERY_SERVER; do # those would be told of our nodes, whatever the range
      [ -z "${!_motor_name:-}" ] || echo "$_motor_name is set and not used, for nodes stay on this machine: export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET to open it." >&2
      unset "$_motor_name"
    done
    ;;
esac
export SKIP_DEFAULT_XML_FILE="${SKIP_DEFAULT_XML_FILE:-1}" # a profile in the working directory is not read
unset _motor_profile _motor_name

_motor_install=local_setup.bash
if [ -f "$_motor_root/.venv/share/rclpy/package.xml" ]; then # ROS 2 from PyPI: the venv is the ament prefix
  case ":${AMENT_PREFIX_PATH:-}:" in
    *":$_motor_root/.venv:"*) ;;
    *)
      if [ -n "${AMENT_PREFIX_PATH:-}" ]; then
        echo "The ROS 2 that was sourced here before is put aside for the workbench's own." >&2
        unset AMENT_PREFIX_PATH CMAKE_PREFIX_PATH PYTHONPATH LD_LIBRARY_PATH
      fi
      export AMENT_PREFIX_PATH="$_motor_root/.venv"
      export CMAKE_PREFIX_PATH="$_motor_root/.venv${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}"
      ;;
  esac
  export ROS_DISTRO=jazzy ROS_VERSION=2 ROS_PYTHON_VERSION=3
  export RMW_IMPLEMENTATION=rmw_fastrtps_cpp # PyPI has no other
elif [ -z "${ROS_DISTRO:-}" ]; then
  _motor_install=setup.bash # the ROS 2 that the workbench was built with is not sourced here: it comes along
elif [ "$ROS_DISTRO" != jazzy ]; then
  echo "The workbench was built with ROS 2 Jazzy, here $ROS_DISTRO is sourced: source env.sh in a new shell." >&2
  unset _motor_root _motor_install
  return 1 2>/dev/null || exit 1
fi
case ":$PATH:" in
  *":$_motor_root/.venv/bin:"*) ;;
  *) export PATH="$_motor_root/.venv/bin:$PATH" ;;
esac
source "$_motor_root/install/$_motor_install"
case $- in *i*) source "$_motor_root/motor_ros/motor_ros/completion.bash" ;; esac # TAB, where somebody types
unset _motor_root _motor_install
