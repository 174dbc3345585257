# shellcheck shell=bash
# What run.sh, build.sh and test.sh share: the packages, and how to get from a fresh clone to a
# binary and a page. Sourced, never run. Every function does nothing when its result is there and
# current, so that a second run needs no network and takes seconds.
# shellcheck disable=SC2034 # the package lists are read by the sourcing scripts

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Names as in Debian 12 and 13. A|B is A where the system offers it, else B.
build_packages=(
    build-essential cmake ninja-build pkg-config
    libvulkan-dev glslang-tools spirv-tools
    libtinygltf-dev nlohmann-json3-dev libmeshoptimizer-dev libdraco-dev libtinyobjloader-dev lib3mf-dev
    libglm-dev 'libboost-url1.81-dev|libboost-url-dev' libspdlog-dev libcli11-dev
    libturbojpeg0-dev libpng-dev libwebp-dev libzstd-dev wabt libopenexr-dev libstb-dev libvpx-dev libmatroska-dev libebml-dev
    libprotobuf-dev protobuf-compiler prometheus-cpp-dev libtomlplusplus-dev libssl-dev
    libseccomp-dev libpoco-dev python3 ca-certificates
)
run_packages=(mesa-vulkan-drivers)
test_packages=(
    vulkan-validationlayers libgtest-dev libgmock-dev libbenchmark-dev libwebm-dev
    python3-websockets python3-yaml openssl curl git ccache mold clang-format universal-ctags
)
build_tools=(c++ cmake ninja pkg-config glslangValidator spirv-val protoc wasm2c node npm)

say() { printf '%s: %s\n' "$(basename "$0")" "$*"; }
die() {
    say "$*" >&2
    exit 1
}

# Node.js and Chromium often come from elsewhere than Debian; whatever is on the PATH will do.
add_unless_on_path() { # LIST COMMAND PACKAGE...
    local -n list=$1
    command -v "$2" >/dev/null || list+=("${@:3}")
}
add_unless_on_path build_packages node nodejs
add_unless_on_path build_packages npm npm
add_unless_on_path test_packages chromium chromium
add_unless_on_path test_packages promtool prometheus
add_unless_on_path test_packages amtool prometheus-alertmanager
add_unless_on_path test_packages kubectl kubernetes-client
add_unless_on_path test_packages /usr/sbin/nginx nginx-light
add_unless_on_path test_packages /usr/sbin/haproxy haproxy
add_unless_on_path test_packages slowhttptest slowhttptest

is_debian_12_or_13() {
    [[ -r /etc/os-release ]] || return 1
    (
        # shellcheck source=/dev/null
        . /etc/os-release
        [[ ${ID:-} == debian && ${VERSION_ID:-} == 1[23] ]]
    )
}

# Prints the packages by their names here: of A|B the first that is offered or installed, or the last.
names_here() {
    local names name
    for names in "$@"; do
        for name in ${names//|/ }; do
            if [[ $name == "${names##*|}" || -n $(apt-cache show "$name" 2>/dev/null) ]]; then
                printf '%s\n' "$name"
                break
            fi
        done
    done
}

# Prints those of the packages that are not installed, by their names here.
missing_packages() {
    local installed
    mapfile -t < <(names_here "$@")
    set -- "${MAPFILE[@]}"
    # shellcheck disable=SC2016 # dpkg-query expands the format
    installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null |
        sed -n 's/^installed //p' || true)
    printf '%s\n' "$@" | grep -vxF -f <(printf '%s\n' "$installed") || true
}

as_root() {
    if ((EUID == 0)); then
        "$@"
    else
        sudo "$@"
    fi
}

apt_get() {
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y \
        -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 -o Dpkg::Options::=--force-confold \
        -o Dpkg::Use-Pty=0 "$@" </dev/null >/dev/null
}

# Tests want these packages' programs, not their daemons: Prometheus' takes the port of our own metrics.
stop_daemons_among() { # PACKAGE...
    [[ -d /run/systemd/system ]] || return 0
    local -A daemons=([prometheus]=prometheus [nginx-light]=nginx [haproxy]=haproxy)
    local package
    for package in "$@"; do
        [[ -z ${daemons[$package]:-} ]] || as_root systemctl disable --quiet --now "${daemons[$package]}"
    done
}

# On Debian 12 and 13 installs what is missing; elsewhere says what is needed and goes on if the tools are
# there (CMake then names any library that is not).
require_packages() {
    local missing
    if is_debian_12_or_13; then
        mapfile -t missing < <(missing_packages "$@")
        ((${#missing[@]})) || return 0
        ((EUID == 0)) || command -v sudo >/dev/null ||
            die "needs root or sudo to install: ${missing[*]}"
        apt_get update
        mapfile -t missing < <(missing_packages "$@") # now that it is known what is offered
        say "installing (this takes minutes): ${missing[*]}"
        apt_get install --no-install-recommends "${missing[@]}"
        stop_daemons_among "${missing[@]}"
        return
    fi
    say "neither Debian 12 nor 13, so nothing is installed; needed are, by their names there: $*"
    missing=()
    local tool
    for tool in "${build_tools[@]}"; do
        command -v "$tool" >/dev/null || missing+=("$tool")
    done
    ((${#missing[@]} == 0)) || die "not found: ${missing[*]}"
}

# Prints the packages of the libraries that a program is linked with, by their names here.
linked_packages() { # PROGRAM
    local program work
    program=$(realpath "$1")
    work=$(mktemp -d)
    mkdir "$work/debian"
    touch "$work/debian/control" # dpkg-shlibdeps works where a package is made
    (cd "$work" && dpkg-shlibdeps -O -e"$program" 2>/dev/null) |
        sed 's/^shlibs:Depends=//; s/ ([^)]*)//g; s/, /\n/g'
    rm -r "$work"
}

# Makes Debian's smallest system in a folder; as root.
make_debian() { # RELEASE FOLDER
    require_packages debootstrap
    say "making Debian $1"
    debootstrap --variant=minbase "$1" "$2" >"$2.log" || die "debootstrap failed: $(tail -1 "$2.log")"
}

# One job a core, but no more than fit into memory: Vulkan's and Boost's headers take over 1 GB.
job_count() {
    local by_cores by_memory
    by_cores=$(nproc)
    by_memory=$(awk '/^MemAvailable/ { print int($2 / 1500000) }' /proc/meminfo)
    if ((by_memory < 1)); then
        by_memory=1
    fi
    echo $((by_cores < by_memory ? by_cores : by_memory))
}

build_binary() { # PRESET
    (
        cd "$root"
        [[ -f build/$1/build.ninja ]] || cmake --preset "$1" >&2
        cmake --build --preset "$1" --parallel "$(job_count)" >&2
    )
}

# Runs a command unless it already succeeded for the same digest.
once_per() { # NAME DIGEST COMMAND...
    local stamp=$root/build/stamps/$1
    [[ -f $stamp && $(<"$stamp") == "$2" ]] && return
    rm -f "$stamp"
    "${@:3}" >&2
    mkdir -p "$(dirname "$stamp")"
    printf '%s\n' "$2" >"$stamp"
}

digest() { sha256sum "$@" | sha256sum | cut -d ' ' -f 1; }

install_node_modules() { # [FOLDER]
    local folder=${1:-client-web}
    local stamp=node_modules${1:+-${1//\//-}}
    (
        cd "$root/$folder"
        [[ -d node_modules ]] || rm -f "$root/build/stamps/$stamp"
        once_per "$stamp" "$(digest package-lock.json)" \
            npm ci --no-audit --no-fund --loglevel=error
    )
}

build_page() {
    install_node_modules
    (
        cd "$root/client-web"
        [[ -f dist/index.html ]] || rm -f "$root/build/stamps/page"
        mapfile -d '' -t sources < <(find . ../protocol/froxel \
            \( -path ./node_modules -o -path ./dist -o -path ./src/gen -o -path ./test-results \) \
            -prune -o -type f -print0 | sort -z)
        once_per page "$(digest "${sources[@]}")" npm run --silent build
    )
}

# Both at once, when the packages are there that both need.
build_page_and_binary() { # PRESET
    install_node_modules
    build_page &
    local page=$! code=0
    build_binary "$1" || code=$?
    wait "$page" || code=$?
    return "$code"
}
