#!/bin/sh
# Form and meaning of the sources; a finding is exit 1. Usage: sh tests/tidy.sh [--since COMMIT | FILE...]
# Formatting of all files, types of the Python, and clang-tidy on src, verification, docs and tests: on all C++ files, or
# those that differ from COMMIT (uncommitted ones too), or the named ones. Headers are judged where they are included,
# and by themselves where they are named or differ. BUILD (default: build) is a configured build folder, JOBS (default:
# the number of processors) how many files are judged at a time. An hour of processor time for all files.
set -eu
. "$(dirname "$0")/../.ci/environment.sh"
build="${BUILD:-build}"
[ -f "$build/compile_commands.json" ] || { echo "$build: not configured; cmake --preset release" >&2; exit 1; }

sh .ci/packages.sh black clang-tidy mypy
sh tests/format.sh
python="forms verification docs/generator tests/documents tests/install"
# shellcheck disable=SC2086  # a list of words
/usr/bin/black --check --quiet $python || { /usr/bin/black --check $python; exit 1; }
root=$PWD
for folder in verification docs/generator tests/documents tests/install; do
    (cd $folder && find . -name '*.py' | xargs /usr/bin/mypy --config-file "$root/pyproject.toml" \
        --python-executable /usr/bin/python3 --cache-dir "$root/$build/mypy")
done

case "${1-}" in
--since)
    git diff --name-only --diff-filter=d "${2:?a commit}"
    git ls-files --others --exclude-standard
    ;;
"") find src verification tests docs -name '*.cpp' ;;
*) printf '%s\n' "$@" ;;
esac | grep -E '^(src|verification|tests|docs)/.*[.](cpp|h)$' | sort -u >"$build/tidy-files" || true
cmake --build "$build" --target kernels

# One call a file: a finding in one does not hide those of the next. GCC's warning options are unknown to it.
xargs -r -n 1 -P "${JOBS:-$(nproc)}" clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
    <"$build/tidy-files" >"$build/tidy-findings" 2>"$build/tidy-errors" || {
    cat "$build/tidy-findings"
    grep -v 'warnings* .*generated' "$build/tidy-errors" >&2 || true
    exit 1
}
echo "clang-tidy: no finding in $(wc -l <"$build/tidy-files") files"
