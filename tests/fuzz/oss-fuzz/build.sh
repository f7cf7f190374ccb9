#!/usr/bin/env bash
# Builds the fuzzers as OSS-Fuzz and ClusterFuzzLite expect them: for each target a program
# $OUT/fuzz_NAME, its options, and its seeds in a zip archive. Reads $SRC, which holds the project
# as "hairbench", $OUT, $WORK, $CC, $CXX, $CFLAGS, $CXXFLAGS, $LIB_FUZZING_ENGINE and $SANITIZER.
set -euo pipefail

project=$SRC/hairbench
build=$WORK/build
# The libraries are Ubuntu's, built with libstdc++.
CXXFLAGS=${CXXFLAGS//-stdlib=libc++/}
# glslang's library has no run-time type information, which -fsanitize=vptr needs.
[[ ${SANITIZER:-address} != undefined ]] || CXXFLAGS+=" -fno-sanitize=vptr"
export CXXFLAGS="$CXXFLAGS -D_GLIBCXX_ASSERTIONS"

# A debug build without flags of its own keeps asserts and OSS-Fuzz's optimisation. The programs run
# where the libraries are not installed, so they look in lib beside them. With the old dynamic tags
# this applies to the libraries' own dependencies too.
cmake -S "$project" -B "$build" -G Ninja -DBUILD_TESTING=OFF -DHAIRBENCH_WERROR=OFF \
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG= -DCMAKE_CXX_FLAGS_DEBUG= \
    -DCMAKE_BUILD_RPATH="\$ORIGIN/lib" -DCMAKE_EXE_LINKER_FLAGS=-Wl,--disable-new-dtags \
    -DHAIRBENCH_FUZZ=ON -DHAIRBENCH_FUZZING_ENGINE="$LIB_FUZZING_ENGINE"
cmake --build "$build" --target fuzzers

fuzzers=$build/tests/fuzz/fuzzers
mkdir -p "$OUT"/lib "$OUT"/scenes/portraits
ldd "$fuzzers" | awk '$2 == "=>" && $3 ~ /^\// && $1 !~ /^lib(c|m|dl|rt|pthread|resolv)\.so/ {print $3}' |
    xargs cp -L -t "$OUT/lib"
# The scenes' target uses these as bases.
cp "$project"/scenes/*.json "$OUT/scenes"
cp "$project"/scenes/portraits/*.json "$OUT/scenes/portraits"

first=
while read -r target options; do
    program=$OUT/fuzz_$target
    if [[ -z $first ]]; then
        cp "$fuzzers" "$program"
        first=$program
    else
        ln -f "$first" "$program"  # they differ only in their names
    fi
    {
        echo "[libfuzzer]"
        tr ' ' '\n' <<<"$options" | sed 's/^-//; s/=/ = /'
    } >"$program.options"
    rm -f "${program}_seed_corpus.zip"
    {
        HAIRBENCH_FUZZ_TARGET=$target "$fuzzers" --seeds
        find "$project/tests/corpus/findings/$target" -type f 2>/dev/null || true
    } | zip -q "${program}_seed_corpus.zip" -@
done < <("$fuzzers" --targets)
