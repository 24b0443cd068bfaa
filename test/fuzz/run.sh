#!/usr/bin/env bash
# Runs every fuzz target for some seconds, one per processor at a time, from the corpus of the tree and what earlier
# runs found. Usage: test/fuzz/run.sh PROGRAMS SECONDS [TARGET...]. PROGRAMS is the folder with fuzz_*. New
# inputs go to PROGRAMS/corpus/TARGET; an input that ends a target goes to PROGRAMS/findings, and
# the exit code is then 1.
set -euo pipefail

export here programs=$1 seconds=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
targets=("$@")
if [[ ${#targets[@]} == 0 ]]; then
  for source in "$here"/targets/*.cpp; do targets+=("$(basename "$source" .cpp)"); done
fi

# Runs a target and prints its line of the table. The processes share nothing but the folder of findings.
fuzz() {
  local target=$1 ended=0
  local found=$programs/corpus/$target log=$programs/findings/$target.log
  mkdir -p "$found"
  local options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 -print_final_stats=1
    -artifact_prefix="$programs/findings/${target}_")
  if [[ -f $here/dictionaries/$target.dict ]]; then options+=(-dict="$here/dictionaries/$target.dict"); fi
  "$programs/fuzz_$target" "${options[@]}" "$found" "$here/corpus/$target" >"$log" 2>&1 || ended=1
  printf '%-12s %10s %12s %10s\n' "$target" "$(find "$here/corpus/$target" -type f | wc -l)" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$(find "$found" -type f | wc -l)"
  if [[ $ended != 0 ]]; then
    tail -n 40 "$log" >&2
    echo "$target was ended by an input, which is in $programs/findings" >&2
  fi
  return "$ended"
}
export -f fuzz

mkdir -p "$programs/findings"
printf '%-12s %10s %12s %10s\n' target inputs executions corpus
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -n 1 bash -c 'fuzz "$0" || exit 1' || exit 1
