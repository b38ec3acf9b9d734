#!/usr/bin/env bash
# Two machines on one wire, as network namespaces of our own: `unshare -rnm two_machines.sh PLANTS STRANGER`.
# PLANTS is a line of bash that starts plants in the background on the first; STRANGER runs on the second, which knows
# the first one's address and looks for it. Neither sees the real network, nor the other's shared memory.
set -u
ip link set lo up
unshare -nm bash -c 'mount -t tmpfs tmpfs /dev/shm && ip link set lo up && exec sleep 300' &
other=$!
trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT
until [ "$(readlink /proc/$other/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.05; done
sleep 0.2
ip link add here type veth peer name there netns $other || exit 77
ip addr add 10.99.0.1/24 dev here && ip link set here up
nsenter -t $other -n ip addr add 10.99.0.2/24 dev there && nsenter -t $other -n ip link set there up
set +u # what the line sources need not be as strict
eval "$1" # a line that the test itself has written
plants=$(jobs -p | grep -v "^$other$")
nsenter -t $other -n -m env -u FASTRTPS_DEFAULT_PROFILES_FILE ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET \
  ROS_STATIC_PEERS=10.99.0.1 bash -c "$2" || exit
for plant in $plants; do # nobody hears a plant that does not run
  kill -0 "$plant" || { echo "a plant has ended before the stranger had listened" >&2; exit 1; }
done
