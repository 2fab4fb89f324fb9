# shellcheck shell=bash
# Sourced after environment.sh: a ROS master of the script's own, and background processes that end with the script.

started=()

# Runs a command in the background, in a session of its own: Ctrl-C reaches it through stop_started alone, once.
# (Bash has background jobs ignore SIGINT, hence the handler.)
start() {
  python3 -c 'import os, signal, sys
os.setsid()
signal.signal(signal.SIGINT, signal.default_int_handler)
os.execvp(sys.argv[1], sys.argv[1:])' "$@" &
  started+=($!)
}

# Ends what was started, the newest first, and waits until it is gone, whatever signals come meanwhile.
stop_started() {
  trap '' INT TERM HUP
  local index
  for ((index = ${#started[@]} - 1; index >= 0; --index)); do
    kill -INT "${started[index]}" 2>/dev/null || continue
    wait "${started[index]}" 2>/dev/null || true
  done
  started=()
}

wait_for() {
  local deadline=$((SECONDS + 30))
  while [ "$SECONDS" -lt "$deadline" ]; do
    "$@" >/dev/null 2>&1 && return
    sleep 0.2
  done
  fail "waited half a minute in vain for: $*"
}

free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'; }

# ROS on this machine only, with a master (yet to be started) that no other script or robot uses.
use_own_master() {
  [ -f "$build_dir/devel/setup.bash" ] || fail "build first: scripts/build"
  source_ros "$build_dir/devel/setup.bash"
  unset ROS_HOSTNAME
  master_port="${CFEM_CUTTING_MASTER_PORT:-$(free_port)}"
  export ROS_IP=127.0.0.1 ROS_MASTER_URI="http://127.0.0.1:$master_port"
}
