#!/bin/sh
# The same source on Debian 13, with its FEniCSx 0.9, PETSc 3.22 and g++ 14: builds, and passes the tests. Needs root
# (chroot) and the network; the mirror is that of this machine. Usage: sh tests/debian_13.sh FOLDER [CTEST_OPTION...]
# FOLDER keeps the system and the build (6 GB), so that a second time takes only what has changed.
# Without options: the C++ tests, and everything that compares the driver with dolfinx.
set -eu
folder=$(realpath -m "${1:?a folder}")
shift
[ $# -gt 0 ] || set -- --tests-regex '^(cpp|matrix|verification\.oracle|cross\..*)$'
. "$(dirname "$0")/../.ci/environment.sh"
mkdir -p "$folder"
system="$folder/system"
. tests/support/debian_root.sh

# The system, once for each list of packages
ready="$folder/ready-$(sha256sum .ci/packages.sh | cut -c 1-16)"
[ -f "$ready" ] || make_system trixie
enter_system
# The files of the repository as they stand. One that is as it was keeps its time, one that differs has the present time:
# times of the repository tell nothing where the folder was filled from another clone.
fresh="$folder/fresh" source="$system/source"
rm -rf "$fresh" && mkdir -p "$fresh" "$source"
git ls-files -z --cached --others --exclude-standard | tar --null --files-from - --create | tar -C "$fresh" --extract --touch
(cd "$source" && find . -path ./build -prune -o ! -type d -print) | while read -r file; do
    [ -e "$fresh/$file" ] || rm -f "$source/$file"
done
(cd "$fresh" && find . ! -type d) | while read -r file; do
    cmp -s "$fresh/$file" "$source/$file" || { mkdir -p "$(dirname "$source/$file")" && cp "$fresh/$file" "$source/$file"; }
done
rm -rf "$fresh"
[ -f "$ready" ] || inside sh -c "cd /source && apt-get update -qq && sh .ci/packages.sh ca-certificates git"
touch "$ready"

inside sh -c '
    set -e
    cd /source
    . .ci/environment.sh
    cmake --preset release >/dev/null
    cmake --build build
    build/thermocontact --version
    ctest --test-dir build --output-on-failure --parallel 2 "$@"' /source/tests/debian_13.sh "$@"
