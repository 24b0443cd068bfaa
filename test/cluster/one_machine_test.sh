#!/usr/bin/env bash
# Four shards by GNU parallel, merged, are the bytes of one run. Usage: one_machine_test.sh CROON CHECKOUT; ends
# with 77 where it cannot run.
# shellcheck source=shards.sh
source "$(dirname "$0")/shards.sh" "$@"

if ! parallel --version 2>/dev/null | grep -q 'GNU parallel'; then skip 'GNU parallel is not installed'; fi
trap 'rm -rf "$folder"' EXIT

write_experiment
run_in_one_piece
# 3, as from croon run: trials failed.
"$scripts/one_machine.sh" "$folder/small.json" "$folder/out" 4 || [[ $? -eq 3 ]]
compare_with_one_piece "$folder/out"
