#!/bin/sh
# Installs what is missing, builds, and runs every test. Usage: sh tests/run.sh [CTEST_OPTION...]
set -eu
. "$(dirname "$0")/../.ci/environment.sh"

sh .ci/packages.sh chromium
cmake --preset release >/dev/null
cmake --build build
ctest --test-dir build --output-on-failure --parallel 2 "$@"
