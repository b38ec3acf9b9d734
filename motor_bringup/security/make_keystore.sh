#!/usr/bin/env bash
# Makes a keystore with keys and permissions for every role of the workbench: make_keystore.sh KEYSTORE [NAMESPACE]
# Needs the `ros2 security` of a ROS 2 distribution; policy.xml beside this says who may do what. See docs/security.md.
set -euo pipefail
here=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")" && pwd -P)
stop() { echo "$*" >&2; exit 1; }

if [ $# -lt 1 ] || [ $# -gt 2 ]; then echo "usage: $0 KEYSTORE [NAMESPACE]" >&2; exit 2; fi
keystore=$1 namespace=${2:-}
namespace=${namespace#/}
[ -z "$namespace" ] || [[ "$namespace" =~ ^[A-Za-z][A-Za-z0-9_]*(/[A-Za-z][A-Za-z0-9_]*)*$ ]] ||
  stop "'$namespace' is no namespace: letters, digits and _ between slashes."
[ ! -e "$keystore" ] || stop "$keystore exists already and is left as it is: choose another name, or remove it."
ros2 security --help >/dev/null 2>&1 ||
  stop "there is no 'ros2 security' here: it comes with a ROS 2 distribution (apt install ros-jazzy-sros2), not from PyPI."

policy=$(mktemp --suffix=.xml)
trap 'rm -f "$policy"' EXIT
if [ -n "$namespace" ]; then # of the motor's own names; /diagnostics, /rosout and the like stay
  sed -E "s#>/(motor|joint_states|experiment|record|play)(/|_[a-z]+/|<)#>/$namespace/\1\2#; s#ns=\"/\"#ns=\"/$namespace\"#" \
    "$here/policy.xml" >"$policy"
else
  cp "$here/policy.xml" "$policy"
fi
umask 077 # keys are nobody else's
ros2 security generate_artifacts -k "$keystore" -p "$policy"
echo "$keystore is made. In every shell: export ROS_SECURITY_KEYSTORE=$(readlink -f "$keystore") ROS_SECURITY_ENABLE=true ROS_SECURITY_STRATEGY=Enforce"
