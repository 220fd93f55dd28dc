# Shared by the scripts here: sourced, never run. Sets `root`, and gives what quickstart and check have in common.
# shellcheck shell=bash disable=SC2034

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Debian 12's names. Boost's Math and Multiprecision are headers and come with libboost-dev.
packages_build=(g++ cmake ninja-build libeigen3-dev libboost-dev librandom123-dev
  libcli11-dev nlohmann-json3-dev libopenexr-dev libpng-dev libpugixml-dev
  libfmt-dev libgnuplot-iostream-dev libboost-iostreams-dev libboost-system-dev libboost-filesystem-dev
  gnuplot-nox fonts-dejavu-core)
packages_check=(python3 poppler-utils glslang-tools libgtest-dev clang-format doxygen libbenchmark-dev libcubature-dev libgsl-dev
  libopenmpi-dev openmpi-bin)
packages_clang=(clang clang-tidy libomp-dev)

say() { printf '\n== %s\n' "$*"; }
die() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# install_missing PACKAGE...: asks nothing, and does nothing where all is there already.
install_missing() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This is not a Debian system; if the build misses something, these are Debian's names of what it needs:"
    echo "  $*"
    return 0
  fi
  local package missing=() as_root=()
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || die "packages are missing that only root can install: apt-get install ${missing[*]}"
    as_root=(sudo)
  fi
  say "Installing ${missing[*]}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq
    -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 -o Dpkg::Use-Pty=0)
  # apt tells of every package at length: kept aside, and shown only when something went wrong.
  local log
  log=$(mktemp)
  if ! { "${apt[@]}" update && "${apt[@]}" install -y --no-install-recommends "${missing[@]}"; } </dev/null >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    rm -f "$log"
    die "apt-get could not install them (its last words are above)"
  fi
  rm -f "$log"
}

# default_jobs: as many compilers at once as there are processors, and 2 GB of free memory for each.
default_jobs() {
  local processors kilobytes group
  processors=$(nproc 2>/dev/null || echo 1)
  kilobytes=$(sed -n 's/^MemAvailable: *\([0-9]*\).*/\1/p' /proc/meminfo 2>/dev/null)
  group=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || true)
  if [[ $group =~ ^[0-9]+$ ]] && [ $((group / 1024)) -lt "${kilobytes:-0}" ]; then kilobytes=$((group / 1024)); fi
  local fit=$((${kilobytes:-2097152} / 2097152))
  [ "$fit" -ge 1 ] || fit=1
  echo $((fit < processors ? fit : processors))
}

# is_count TEXT: a whole number from 1 up.
is_count() { [[ $1 =~ ^[1-9][0-9]*$ ]]; }

# seconds_since START: START is an earlier $EPOCHREALTIME.
seconds_since() { awk -v a="$1" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }'; }
