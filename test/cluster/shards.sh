# shellcheck shell=bash disable=SC2034
# What the tests of the cluster's scripts share: a small experiment, a run of it in one piece, and the
# comparison with it. Sourced, with the program and the checkout as arguments.
set -euo pipefail

export CROON=$1
scripts=$2/experiments/cluster
folder=$(mktemp -d)

skip() {
  rm -rf "$folder"
  echo "skipped: $*"
  exit 77
}

# In the variant "nothing left" every trial fails: shards end with 3, and are to be merged all the same.
write_experiment() {
  cat >"$folder/small.json" <<'JSON'
{
  "name": "small",
  "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 3},
  "starts": {"rotation_deg": 10, "translation_m": 0.1, "trials": 3},
  "success": {"rotation_deg": 5, "translation_m": 0.5},
  "pipeline": [
    {"step": "preprocessing", "sensor": [{"type": "voxel_downsample", "leaf_size_m": 0.5}]},
    {"step": "ground_alignment"},
    {"step": "planar_alignment"}
  ],
  "variants": [
    {"name": "nothing left", "replace": {"preprocessing.sensor": [{"type": "range_crop", "min_m": 900, "max_m": 1000}]}}
  ]
}
JSON
}

# Exit code 3 is as it should be: trials failed.
run_in_one_piece() {
  "$CROON" run "$folder/small.json" --out "$folder/whole" --quiet >"$folder/whole.log" 2>&1 || [[ $? -eq 3 ]]
}

# $1: the folder of the merged results.
compare_with_one_piece() {
  for file in trials.csv summary.csv summary.json; do
    cmp "$folder/whole/$file" "$1/$file"
  done
  grep -q ',success,' "$1/trials.csv"
  grep -q ',failed,' "$1/trials.csv"
  echo "the same bytes: $(($(wc -l <"$1/trials.csv") - 1)) trials"
}
