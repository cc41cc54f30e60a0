#!/bin/sh
# The paper's example from nothing to its pictures: installs what is missing, builds, runs scenes/paper.toml for a cold
# and a hot foundation, draws. Usage: sh scenes/paper.sh [OUTPUT_FOLDER]
set -eu
output=$(realpath -m "${1:-paper-results}")
. "$(dirname "$0")/../.ci/environment.sh"

sh .ci/packages.sh
cmake --preset release >/dev/null
cmake --build build --target thermocontact
foundation=boundary.bottom.contact.conductance.foundation_temperature
build/thermocontact run scenes/paper.toml --set $foundation=0.0 --output "$output/cold"
build/thermocontact run scenes/paper.toml --set $foundation=10.0 --output "$output/hot"
"$(sed -n 's/^FFCX_PYTHON:FILEPATH=//p' build/CMakeCache.txt)" verification/figures.py \
    "$output/cold" "$output/hot" --output "$output/figures"
echo "pictures in $output/figures"
