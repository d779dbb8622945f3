# shellcheck shell=bash
# Sourced by experiments/reproduce and tests/run: installs what is missing and builds a preset. Safe to repeat, quick when nothing is to do.

# wanted_packages [tests | extended]: those of packages.txt that stand below no line "for … only", and with "extended" those for the extended
# suite; with "tests" all of them.
wanted_packages() {
  awk -v want="${1-}" '
    /^# for .* only/ { only = /suite extended/ ? "extended" : "tests"; next }
    /^#/ { only = ""; next }
    NF && (only == "" || only == want || want == "tests") { print $1 }' packages.txt
}

# is_there PACKAGE: whether it is installed, or what it is for is there without it.
is_there() {
  [ "$1" != npm ] || ! command -v npm >/dev/null || return 0
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# missing_packages [tests | extended]: the wanted packages that are not there.
missing_packages() {
  local package
  for package in $(wanted_packages "$@"); do
    is_there "$package" || echo "$package"
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

# install_packages [tests | extended]: installs what is missing.
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
