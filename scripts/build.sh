# Configures and builds build/release; sourced by scripts/demo and scripts/test.

say() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; }

# build_release NAME [-D... options and targets]: no targets means all. What CMake says is shown when it fails; what
# Ninja says, too, and its count of steps on a terminal. Files of a folder are compiled together, which takes less than
# half the time; where two of them do not go together, each is compiled by itself.
build_release() {
  local name=$1 options=() targets=() word log build together
  shift
  for word in "$@"; do
    case "$word" in -*) options+=("$word") ;; *) targets+=("$word") ;; esac
  done
  log=build/$name.log
  mkdir -p build
  # In continuous integration a warning stops the build; for who only builds it does not.
  case "${CI:-}" in '' | 0 | false) ;; *) options+=(-DCMAKE_COMPILE_WARNING_AS_ERROR=ON) ;; esac
  build=(cmake --build --preset release ${targets[0]+--target "${targets[@]}"})
  for together in ON OFF; do
    say "configuring build/release"
    cmake --preset release "${options[@]}" -DOROGRAPH_JOIN_FILES=$together >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
    say "building"
    if [ -t 1 ]; then "${build[@]}" && return
    elif "${build[@]}" >"$log" 2>&1; then return
    fi
    [ $together = OFF ] || {
      cp "$log" "$log.joined"
      grep -E -m 12 'FAILED|error|Killed|No space' "$log" >&2 || true
      say "the build failed ($log.joined): once more, each file by itself"
    }
  done
  if [ -t 1 ]; then say "the build failed"; exit 1; fi
  grep -v '^\[' "$log" | tail -n 60 >&2
  say "the build failed; all it said is in $log"
  exit 1
}

# run_each PROGRAM: each test of a GoogleTest program in a process of its own, as many at a time as there are processors.
# Shows what the tests print of themselves, and fails when one of them does.
run_each() {
  "$1" --gtest_list_tests | awk '/^[^ ]/ { suite = $1 } /^ / { print suite $1 }' |
    PROGRAM=$1 xargs -P "$(nproc)" -I '{}' bash -c '
      said=$("$PROGRAM" --gtest_filter="{}" 2>&1) && code=0 || code=$?
      printf "%s: %s\n" "{}" "$([ $code = 0 ] && echo passed || echo FAILED)"
      grep -vE "^(\[|Running|Note:|$)| tests? from |PASSED|FAILED" <<<"$said" | sed "s/^/    /" || true
      exit $code'
}
