# shellcheck shell=bash
# Debian packages that the scripts need, in one place. Sourced, not run.
#
# A word is PACKAGE or PACKAGE:COMMAND; with a command, the package counts as present when the command is
# there, however it was installed.

declare -A packages=(
    [build]='cmake:cmake ninja-build:ninja g++:g++ libfmt-dev libcli11-dev nlohmann-json3-dev libtbb-dev libpng-dev zlib1g-dev libasmjit-dev libpugixml-dev libfreetype-dev libopenvdb-dev libboost-dev'
    [test]='doctest-dev fonts-dejavu-core libmpfr-dev libgmp-dev admesh:admesh lib3mf-dev libxml2-utils:xmllint libcgal-dev nodejs:node npm:npm'
    [ci]='clang-14:clang++-14 libclang-rt-14-dev llvm-14:llvm-symbolizer-14 clang-format-14:clang-format-14'
)

# package_present WORD: true when nothing needs to be installed for it.
package_present() {
    local package=${1%%:*}
    if [[ $1 == *:* ]] && command -v "${1##*:}" >/dev/null; then
        return 0
    fi
    [[ $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) == 'install ok installed' ]]
}

# ensure_packages GROUP...: installs what is missing of the groups (build, test, ci). Asks for root only then.
ensure_packages() {
    local group word missing=()
    for group in "$@"; do
        for word in ${packages[$group]}; do
            package_present "$word" || missing+=("${word%%:*}")
        done
    done
    [[ ${#missing[@]} -gt 0 ]] || return 0
    if ! command -v apt-get >/dev/null; then
        echo "missing, and there is no apt-get to install it: ${missing[*]}" >&2
        return 1
    fi
    echo "installing: ${missing[*]}"
    local as_root=()
    if [[ $(id -u) -ne 0 ]]; then
        if ! command -v sudo >/dev/null; then
            echo "run this as root once, or install by hand: apt-get install ${missing[*]}" >&2
            return 1
        fi
        as_root=(sudo)
    fi
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q update
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get -q install -y --no-install-recommends "${missing[@]}"
}
