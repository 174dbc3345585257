#!/usr/bin/env bash
# Tries README.md's two commands on a bare Debian: in a folder that debootstrap fills, from a fresh clone of
# what is committed here, with this host's network. As root, on Debian:
#   ./deploy/try_debian.sh [RELEASE (trixie)] [COMMAND...]
# With COMMAND that is run there instead, such as ./deploy/build.sh.
# shellcheck source=deploy/common.sh
source "$(dirname "$0")/common.sh"

release=${1:-trixie}
work=$(mktemp -d /var/tmp/froxel-debian.XXXXXX)
trap 'rm -rf "$work"' EXIT
system=$work/system

# Runs a command in the clone there. What it mounts and starts ends with it. What this host trusts, npm does
# there too.
inside() { # COMMAND...
    # shellcheck disable=SC2016 # expanded in there
    unshare --mount --pid --fork --kill-child bash -euc '
        mount -t proc proc "$0/proc"
        mount --rbind /sys "$0/sys"
        mount --rbind /dev "$0/dev"
        exec chroot "$0" env -i -C /froxel HOME=/root LANG=C.UTF-8 \
            PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
            NODE_EXTRA_CA_CERTS=/opt/authorities.crt "$@"' "$system" "$@"
}

# run.sh, until viewers may come and it has stopped as it is told to.
# shellcheck disable=SC2016
run_and_stop='
    coproc server { exec ./deploy/run.sh --device cpu --port 0 --admin-bind 127.0.0.1:0; }
    pid=$server_PID
    addresses=()
    while ((${#addresses[@]} < 2)) && read -r line; do
        if [[ $line == http://* ]]; then addresses+=("$line"); else echo "$line"; fi
    done <&"${server[0]}"
    ((${#addresses[@]} == 2))
    for ((i = 0; i < 300; ++i)); do
        build/release/froxel probe "${addresses[1]/metrics/readyz}" >/dev/null && break
        sleep 1
    done
    ((i < 300))
    echo "${addresses[0]} is ready"
    kill "$pid"
    wait "$pid"'

make_debian "$release" "$system"
# Packages must start no daemons there.
install -m 755 /dev/stdin "$system/usr/sbin/policy-rc.d" <<<$'#!/bin/sh\nexit 101'
cp /etc/ssl/certs/ca-certificates.crt "$system/opt/authorities.crt"
git clone --quiet --no-hardlinks "$root" "$system/froxel"

if (($# > 1)); then
    inside "${@:2}"
else
    say "run.sh"
    inside bash -euo pipefail -c "$run_and_stop"
    say "test.sh"
    inside ./deploy/test.sh
fi
