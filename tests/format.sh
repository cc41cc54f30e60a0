#!/bin/sh
# Every C and C++ file is formatted as .clang-format says; exit 1 names the places. sh tests/format.sh --mend formats.
set -eu
. "$(dirname "$0")/../.ci/environment.sh"
[ "${1-}" = --mend ] && how="-i" || how="--dry-run -Werror"
# shellcheck disable=SC2086  # a list of words
find src tests verification docs examples -name '*.cpp' -o -name '*.h' -o -name '*.c' | sort | xargs clang-format $how
