# shellcheck shell=bash
# Sourced by experiments/reproduce and tests/run: installs what is missing and builds a preset. Safe to repeat, quick when nothing is to do.

# missing_packages [tests]: the packages of packages.txt that are not installed; with "tests" those that only the tests need too.
missing_packages() {
  local package last='/^# for .*run only/q'
  [ "${1-}" != tests ] || last=
  sed "$last" packages.txt | sed 's/#.*//' | while read -r package; do
    [ -n "$package" ] || continue
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

# Runs a command as root: directly, or by sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "to install packages, run this as root or install sudo: $*" >&2
    return 1
  fi
}

# install_packages [tests]: installs what is missing.
install_packages() {
  local missing
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  echo "installing: ${missing//$'\n'/ }"
  as_root apt-get update -qq
  # shellcheck disable=SC2086  # one word a package
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
}

# build_preset NAME: configures (again, if need be) and builds.
build_preset() {
  mkdir -p build
  cmake --preset "$1" >"build/$1.log" 2>&1 || { cat "build/$1.log" >&2; rm -f "build/$1.log"; return 1; }
  rm -f "build/$1.log"
  cmake --build --preset "$1" -j "$(nproc)"
}
