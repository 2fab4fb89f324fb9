# shellcheck shell=bash
# Sourced by the scripts beside it (bash): where the package lies, which tools come first, how to talk.

package_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build_dir="${CFEM_CUTTING_BUILD_DIR:-$package_dir/.build}"

say() { printf '\n==> %s\n' "$*"; }
fail() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# Retries a command that may fail for a moment, such as one that needs the network.
retry() {
  local attempt
  for attempt in 1 2 3 4; do
    "$@" && return 0
    [ "$attempt" = 4 ] || { echo "attempt $attempt failed, trying again: $*" >&2; sleep $((attempt * 5)); }
  done
  return 1
}

# Runs a command as root.
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "needs root and there is no sudo; run as root: $*"
  fi
}

# A set-up file of ROS or of a catkin workspace; these trip over `set -u` and over positional arguments.
source_ros() {
  local setup_file="$1"
  set --
  set +u
  # shellcheck disable=SC1090
  . "$setup_file"
  set -u
}

# A ROS 1 in /opt/ros (roscpp tells it from ROS 2), or nothing where ROS comes with the system.
opt_ros() {
  local candidate
  for candidate in /opt/ros/noetic /opt/ros/*; do
    if [ -d "$candidate/share/roscpp" ] && [ -f "$candidate/setup.bash" ]; then
      echo "$candidate"
      return
    fi
  done
}

# Catkin needs the system's Python, not one of pyenv or conda that may come first on PATH.
export PATH="/usr/bin:/bin:/usr/sbin:/sbin:$PATH"
ros_root="$(opt_ros)"
if [ -n "$ros_root" ]; then
  source_ros "$ros_root/setup.bash"
fi
