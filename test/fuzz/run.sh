#!/usr/bin/env bash
# Runs every fuzz target for some seconds, from the corpus of the tree and what earlier runs found.
# Usage: test/fuzz/run.sh PROGRAMS SECONDS [TARGET...]. PROGRAMS is the folder with fuzz_*. New
# inputs go to PROGRAMS/corpus/TARGET; an input that ends a target goes to PROGRAMS/findings, and
# the exit code is then 1.
set -euo pipefail

programs=$1
seconds=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
targets=("$@")
if [[ ${#targets[@]} == 0 ]]; then
  for source in "$here"/targets/*.cpp; do targets+=("$(basename "$source" .cpp)"); done
fi

mkdir -p "$programs/findings"
failed=()
printf '%-12s %10s %12s %10s\n' target inputs executions corpus
for target in "${targets[@]}"; do
  found="$programs/corpus/$target"
  mkdir -p "$found"
  log="$programs/findings/$target.log"
  options=(-max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -malloc_limit_mb=1024 -print_final_stats=1
    -artifact_prefix="$programs/findings/${target}_")
  if [[ -f $here/dictionaries/$target.dict ]]; then options+=(-dict="$here/dictionaries/$target.dict"); fi
  if ! "$programs/fuzz_$target" "${options[@]}" "$found" "$here/corpus/$target" >"$log" 2>&1; then
    failed+=("$target")
    tail -n 40 "$log" >&2
  fi
  printf '%-12s %10s %12s %10s\n' "$target" "$(find "$here/corpus/$target" -type f | wc -l)" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$(find "$found" -type f | wc -l)"
done
if [[ ${#failed[@]} != 0 ]]; then
  echo "Ended by an input: ${failed[*]}; the inputs are in $programs/findings" >&2
  exit 1
fi
