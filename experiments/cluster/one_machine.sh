#!/usr/bin/env bash
# An experiment on one big machine: N shards of one thread each by GNU parallel, then merged into OUT.
# Usage: one_machine.sh EXPERIMENT OUT N [options of croon run]
# As many shards run at once as there are cores; PARALLEL sets options of GNU parallel. Stopped and started
# again, every shard goes on where it was. The program is CROON (default: croon on the path).
set -euo pipefail

if [[ $# -lt 3 || ! $3 =~ ^[1-9][0-9]*$ ]]; then
  echo 'Usage: one_machine.sh EXPERIMENT OUT N [options of croon run]' >&2
  exit 2
fi
experiment=$1 out=$2 shards=$3
shift 3
program=${CROON:-croon}
folders=()
for ((shard = 1; shard <= shards; ++shard)); do folders+=("$out/shard.$shard"); done
mkdir -p "$out/log"

run_shard() {
  local shard=$1 status=3
  shift
  # With 3 some trial failed, which croon merge says again, or its files could not be read just then: a second run runs
  # the latter alone.
  for _ in 1 2; do
    if [[ $status -ne 3 ]]; then break; fi
    status=0
    "$program" run "$experiment" --shard "$shard/$shards" --out "$out/shard.$shard" --jobs 1 --quiet "$@" \
      >"$out/log/shard.$shard.log" 2>&1 || status=$?
  done
  if [[ $status -eq 0 || $status -eq 3 ]]; then return 0; fi
  cat "$out/log/shard.$shard.log" >&2
  return "$status"
}
export -f run_shard
export experiment out shards program PARALLEL_SHELL=$BASH

seq "$shards" | parallel --quote --halt soon,fail=1 run_shard {} "$@"
"$program" merge "${folders[@]}" --out "$out"
