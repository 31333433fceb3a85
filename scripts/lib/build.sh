# shellcheck shell=bash
# Configuring, building and testing, shared by the scripts. Sourced, not run; needs $root.

# jobs: how many compilers to run: one a core, but one for each 1.5 GiB of memory at most. FREP_JOBS overrules.
jobs() {
    local cores kib by_memory
    if [[ -n ${FREP_JOBS:-} ]]; then
        echo "$FREP_JOBS"
        return
    fi
    cores=$(nproc)
    kib=$(awk '/^MemTotal:/ { print $2 }' /proc/meminfo)
    by_memory=$((kib / 1536 / 1024))
    if [[ $by_memory -lt 1 ]]; then by_memory=1; fi
    echo $((cores < by_memory ? cores : by_memory))
}

# shared_folder: the folder with shared test data (FREP_SHARED, by default ../shared), or nothing.
shared_folder() {
    local folder=${FREP_SHARED-$root/../shared}
    if [[ -n $folder && -d $folder ]]; then
        (cd "$folder" && pwd)
    fi
}

# configure_preset PRESET [cmake options...]: configures a preset of CMakePresets.json; quiet unless it fails.
configure_preset() {
    local preset=$1 log=$root/out/configure-$1.log
    shift
    (cd "$root" && cmake --preset "$preset" -DFREP_SHARED="$(shared_folder)" "$@") >"$log" 2>&1 ||
        { cat "$log" >&2; return 1; }
}

# build_preset PRESET [cmake options...]: configures and builds everything.
build_preset() {
    configure_preset "$@" && (cd "$root" && cmake --build --preset "$1" -j "$(jobs)")
}

# build_program PRESET [cmake options...]: configures and builds the program frep only.
build_program() {
    configure_preset "$@" && (cd "$root" && cmake --build --preset "$1" -j "$(jobs)" --target frep)
}

# run_tests PRESET [ctest options...]: runs the tests of a build and adds their counts to $passed, $failed and
# $skipped. The log of ctest goes to out/test-PRESET.log.
run_tests() {
    local preset=$1 status=0 log folder
    shift
    log=$root/out/test-$preset.log
    (cd "$root" && ctest --preset "$preset" -j "$(jobs)" "$@" -O "$log") || status=$?
    folder=$(sed -n 's/^Internal ctest changing into directory: //p; s/^Test project //p' "$log" | head -n 1)
    count_tests "$log" "$folder/Testing/Temporary/LastTest.log"
    # A line "skipped: N (reason)" of a test says what did not run; show each once.
    grep '^skipped: [1-9]' "$folder/Testing/Temporary/LastTest.log" | sort -u || true
    if [[ $status -ne 0 && $failed -eq 0 ]]; then failed=1; fi
}

passed=0 failed=0 skipped=0

# count_tests CTEST-OUTPUT LASTTEST-LOG: adds to $passed, $failed, $skipped. A doctest program counts with its
# test cases, any other test as one; a line "skipped: N (reason)" adds N skipped ones.
count_tests() {
    local counts
    counts=$(awk '
        FNR == NR {
            if (match($0, /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: /)) {
                rest = substr($0, RLENGTH + 1)
                name = rest
                sub(/ .*/, "", name)
                status[name] = rest ~ / Passed / ? "passed" : rest ~ /\*\*\*(Skipped|Not Run \(Disabled\)) / ? "skipped" : "failed"
            }
            next
        }
        /^[0-9]+\/[0-9]+ Testing: / { name = $3 }
        /^\[doctest\] test cases:/ {
            line = $0
            gsub(/[^0-9|]/, "", line)
            split(line, number, "|")
            p[name] += number[2]; f[name] += number[3]; skip += number[4]; cases[name] = 1
        }
        /^skipped: [0-9]+ / { skip += $2 }
        END {
            for (name in status) {
                if (name in cases) {
                    pass += p[name]; fail += f[name]
                    if (status[name] == "failed" && !f[name]) fail++
                } else if (status[name] == "passed") pass++
                else if (status[name] == "skipped") skip++
                else fail++
            }
            printf "%d %d %d", pass, fail, skip
        }
    ' "$1" "$2")
    local p f s
    read -r p f s <<<"$counts"
    passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
}

# check NAME COMMAND...: runs a check that counts as one test.
check() {
    local name=$1
    shift
    if "$@"; then
        echo "check passed: $name"
        passed=$((passed + 1))
    else
        echo "check FAILED: $name" >&2
        failed=$((failed + 1))
    fi
}

# run_fuzzer PROGRAM SECONDS: runs the fuzz program fuzz_NAME on its seeds in fuzz/corpus/NAME with the words of
# fuzz/NAME.dict, or else of HyperFun; what it finds goes to out/fuzz/.
run_fuzzer() {
    local name folder words
    name=$(basename "$1")
    folder=$root/out/fuzz/$name
    mkdir -p "$folder/corpus"
    words=$root/fuzz/${name#fuzz_}.dict
    [[ -f $words ]] || words=$root/fuzz/hyperfun.dict
    "$1" -max_total_time="$2" -timeout=20 -rss_limit_mb=4096 -print_final_stats=1 -artifact_prefix="$folder/" \
        -dict="$words" "$folder/corpus" "$root/fuzz/corpus/${name#fuzz_}" >"$folder/log" 2>&1 ||
        { tail -n 40 "$folder/log" >&2; return 1; }
    grep -a 'stat::number_of_executed_units' "$folder/log" || true
}
