# Puts the workbench on the path of this bash: `source env.sh`.
if [ -z "${BASH_VERSION:-}" ]; then
  echo "env.sh is for bash: start bash, then 'source env.sh'." >&2
  return 1 2>/dev/null || exit 1
fi
_motor_root="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
if [ ! -x "$_motor_root/.venv/bin/python" ] || [ ! -f "$_motor_root/install/local_setup.bash" ]; then
  echo "The workbench is not built here yet: run $_motor_root/setup.sh, then source env.sh again." >&2
  unset _motor_root
  return 1 2>/dev/null || exit 1
fi

# Nothing leaves this machine, and no stranger's node moves a motor, unless you say so.
export ROS_AUTOMATIC_DISCOVERY_RANGE="${ROS_AUTOMATIC_DISCOVERY_RANGE:-LOCALHOST}"

case ":$PATH:" in
  *":$_motor_root/.venv/bin:"*) ;;
  *) export PATH="$_motor_root/.venv/bin:$PATH" ;;
esac
if [ -f "$_motor_root/.venv/share/rclpy/package.xml" ]; then # ROS 2 from PyPI: the venv is the ament prefix
  export ROS_DISTRO=jazzy ROS_VERSION=2 ROS_PYTHON_VERSION=3
  case ":${AMENT_PREFIX_PATH:-}:" in
    *":$_motor_root/.venv:"*) ;;
    *) export AMENT_PREFIX_PATH="$_motor_root/.venv${AMENT_PREFIX_PATH:+:$AMENT_PREFIX_PATH}" ;;
  esac
  case ":${CMAKE_PREFIX_PATH:-}:" in
    *":$_motor_root/.venv:"*) ;;
    *) export CMAKE_PREFIX_PATH="$_motor_root/.venv${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}" ;;
  esac
fi
source "$_motor_root/install/local_setup.bash"
unset _motor_root
