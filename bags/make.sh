#!/usr/bin/env bash
# Makes the golden recordings again, all or those that are named: bags/make.sh DIRECTORY [BAG…]. The live ones take real time.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
out="${1:?usage: bags/make.sh DIRECTORY [step|rich|emulated|closed_loop]… (the directory must not hold them yet)}"
shift
[ $# -gt 0 ] || set -- step rich emulated closed_loop
mkdir -p "$out"

running=()
begin() { setsid "$@" & running=("$!" "${running[@]}"); } # a group of its own: the genuine `ros2 run` has a child
finish() { # the latest first, so that nobody misses anybody
  for pid in "${running[@]}"; do
    kill -TERM -- "-$pid" 2>/dev/null || true
    wait "$pid" || true
  done
  running=()
}
trap finish EXIT

step() { ros2 run motor_identification experiment step --model "$here/paper.yaml" --voltage 10 --seed 1 --output "$out/step"; }

rich() {
  ros2 run motor_identification experiment rich --model "$here/rich.yaml" --slot-irregularity 0.01 --seed 2 --output "$out/rich"
}

emulated() {
  begin ros2 run motor_board board_emulator --ros-args -p link:="$out/board" -p model:="$here/emulated.yaml" -p seed:=3
  begin ros2 run motor_driver motor_driver --ros-args -p port:="$out/board" -p max_voltage:=9.0
  ros2 run motor_identification experiment prbs --output "$out/emulated"
  finish
}

closed_loop() {
  begin ros2 run motor_sim motor_sim --ros-args -p model:="$here/closed_loop.yaml" -p seed:=4
  begin ros2 run motor_control motor_control --ros-args --params-file "$here/low_gain.yaml"
  begin ros2 run motor_identification record "$out/closed_loop" motor/speed motor/info motor/voltage motor/reference motor/control_state
  for reference in 40.0 100.0 20.0 130.0 60.0 0.0; do
    ros2 topic pub --once /motor/reference std_msgs/msg/Float64 "{data: $reference}"
    sleep 1
  done
  finish
}

for bag in "$@"; do "$bag"; done
