#!/bin/sh
# Builds the fuzzers of the readers with Clang, address and undefined-behaviour sanitizers, and runs each for so many
# seconds; new inputs are kept in the build folder. Usage: sh tests/fuzz/run.sh SECONDS BUILD_FOLDER [FUZZER...]
set -eu
seconds=$1 build=$2
shift 2
[ $# -gt 0 ] || set -- scene expression override gmsh
source=$(cd "$(dirname "$0")" && pwd)

cmake -S "$source/../.." -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DTHERMOCONTACT_FUZZ=ON -DTHERMOCONTACT_TESTS=OFF >/dev/null
ninja -C "$build" fuzzers >/dev/null

for name in "$@"; do
    mkdir -p "$build/found/$name"
    # Gmsh's library leaks where it fails; it runs in a process of its own that ends
    leaks=1
    [ "$name" = gmsh ] && leaks=0
    ASAN_OPTIONS=allocator_may_return_null=1 "$build/tests/fuzz/fuzz_$name" -max_total_time="$seconds" \
        -timeout=10 -rss_limit_mb=1024 -max_len=20000 -detect_leaks=$leaks -verbosity=0 -print_final_stats=1 \
        -dict="$source/$name.dict" -artifact_prefix="$build/found/$name-" \
        "$build/found/$name" "$source/corpus/$name" 2>"$build/found/$name.log" ||
        { cat "$build/found/$name.log"; echo "fuzz_$name: FAILED"; exit 1; }
    echo "fuzz_$name: $(sed -n 's/stat::number_of_executed_units: *//p' "$build/found/$name.log") inputs, no finding"
done
