#!/bin/sh
# Builds this commit in a root of another Debian, made with debootstrap, and runs the tests there that compare the two
# programs. Usage, as root: sh tests/other_debian.sh [SUITE [FOLDER [CTEST_OPTION...]]]
# SUITE: trixie (Debian 13, FEniCSx 0.9). FOLDER (default: build/SUITE) keeps the root, 3 GB, which a second call uses again.
set -eu
. "$(dirname "$0")/../.ci/environment.sh"
suite="${1:-trixie}"
root="$(realpath -m "${2:-build/$suite}")"
[ $# -le 2 ] && set -- -L cross || shift 2
[ "$(id -u)" -eq 0 ] || { echo "a root of $suite can only be made as root" >&2; exit 1; }

sh .ci/packages.sh debootstrap
if [ ! -e "$root/complete" ]; then
    rm -rf "$root"
    debootstrap --variant=minbase "$suite" "$root" >"$root.log" || { tail "$root.log" >&2; exit 1; }
    touch "$root/complete"
fi

# what is unchanged keeps its time, so that a second call builds little
rm -rf "$root/source.new"
mkdir -p "$root/source" "$root/source.new"
git archive HEAD | tar -x -C "$root/source.new"
cd "$root/source.new" && find . -type f | while read -r file; do
    cmp -s "$file" "$root/source/$file" || { mkdir -p "$(dirname "$root/source/$file")"; cp -p "$file" "$root/source/$file"; }
done
rm -rf "$root/source.new"

# mounts of its own, which end with it; MPI wants /proc, /dev and /sys
# shellcheck disable=SC2016  # for the shell inside
exec unshare --mount sh -c '
    root="$1"
    shift
    for folder in proc dev sys; do mount --rbind "/$folder" "$root/$folder"; done
    cp /etc/resolv.conf "$root/etc/"
    exec chroot "$root" sh -c "
        set -eu
        cd /source
        sh .ci/packages.sh
        cmake --preset release >/dev/null
        cmake --build build
        ctest --test-dir build --output-on-failure --parallel 2 \"\$@\"" sh "$@"' sh "$root" "$@"
