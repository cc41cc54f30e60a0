#!/bin/sh
# Installs what thermocontact needs from Debian's packages, and those named; does nothing when all of it is there.
set -eu

command -v npm >/dev/null || set -- "$@" npm # of Debian's or of another origin
packages="g++ clang clang-format libclang-rt-dev cmake ninja-build pkg-config
    libbasix-dev libcli11-dev libeigen3-dev libgmsh-dev libmetis-dev libmuparser-dev libopenblas-pthread-dev
    libopenblas0-pthread libopenmpi-dev petsc-dev
    libhdf5-dev libspectra-dev libsuitesparse-dev libtomlplusplus-dev nlohmann-json3-dev libgtest-dev
    python3 python3-dolfinx python3-ffcx python3-gmsh python3-markdown python3-matplotlib python3-mpmath python3-scipy
    openmpi-bin fish man-db mandoc zsh
    $*"

missing=""
for package in $packages; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q "ok installed" || missing="$missing $package"
done
[ -z "$missing" ] && exit 0

if [ "$(id -u)" -eq 0 ]; then
    as_root=""
elif command -v sudo >/dev/null 2>&1; then
    as_root="sudo"
else
    echo "these packages are missing, and installing them takes root or sudo:$missing" >&2
    exit 1
fi
echo "installing:$missing"
$as_root apt-get update -qq
# shellcheck disable=SC2086  # a list of words
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
