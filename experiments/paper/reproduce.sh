#!/usr/bin/env bash
# Runs the paper's experiments and writes their results, beside the paper's numbers, to a dated page of
# docs/notebook. Experiments on recordings run only if the recordings are installed.
# Usage: experiments/paper/reproduce.sh [DATA_ROOT], from the root of the tree; DATA_ROOT is by
# default $CROON_DATA, else data. CROON is the program, by default build/release/bin/croon; RESULTS the
# folder of the results, by default results/paper. What is in there already is not run again.
set -euo pipefail

croon=${CROON:-build/release/bin/croon}
data=${1:-${CROON_DATA:-data}}
results=${RESULTS:-results/paper}
page=docs/notebook/$(date +%F)-which-numbers-of-the-paper-hold.md

folders=()
# run NAME ARGUMENTS...: croon run ARGUMENTS into $results/NAME. With code 3 some trial failed, a result like others, or
# its files could not be read just then; a second run runs the latter alone.
run() {
  local name=$1 code=3
  shift
  for _ in 1 2; do
    if [[ $code != 3 ]]; then break; fi
    code=0
    "$croon" run "$@" --data "$data" --out "$results/$name" || code=$?
  done
  if [[ $code != 0 && $code != 3 ]]; then exit "$code"; fi
}

# run_experiment NAME: one whose numbers the page compares with the paper's.
run_experiment() {
  run "$1" "experiments/paper/$1.json"
  folders+=("$results/$1")
}

run_experiment table1_simulated
run_experiment table1_opencalib_2022_03
run_experiment consistency_simulated
if [[ -d $data/opencalib/real ]]; then run_experiment real_consistency; fi
if [[ -d $data/opencalib/carla ]]; then run_experiment carla_samples; fi

noises=()
for noise in none real_still real; do
  run "noise_$noise" experiments/paper/pipeline.json --with "experiments/workloads/noise_$noise.json" --trials 1
  noises+=("$results/noise_$noise")
done

# table FOLDER... [-- KIND...]: experiments side by side, for the kinds of scenes given or for all.
table() {
  local shown=() kinds=()
  while [[ $# != 0 && $1 != -- ]]; do shown+=("$1"); shift; done
  if [[ $# != 0 ]]; then kinds=(--kinds "${@:2}"); fi
  "$croon" export "${shown[@]}" --units mm "${kinds[@]}" \
    --columns success success_interval rotation_median translation_median
}

# Written whole or not at all. Code 3: a number is not in its band, and the page says which.
code=0
{
  echo "# $(date +%F): Which numbers of the paper are reproduced?"
  echo
  echo '<!-- Written by `experiments/paper/reproduce.sh`. -->'
  echo
  echo 'Numbers that the paper (CROON, arXiv 2203.03182) claims, and ours. A number outside its band is said to be out; no'
  echo 'band was widened to hold it.'
  echo
} >"$page.new"
"$croon" claims "${folders[@]}" >>"$page.new" || code=$?
if [[ $code != 0 && $code != 3 ]]; then exit "$code"; fi
{
  echo
  echo "## Ours and the authors' code, on the 1899 scenes"
  echo
  table "$results/table1_simulated" "$results/table1_opencalib_2022_03"
  echo
  echo '## Without noise, with noise, and driving'
  echo
  table "${noises[@]}"
  for kind in urban suburban crossing car_park highway narrow empty blocked corridor; do
    echo
    echo "### Scenes of the kind \`$kind\`"
    echo
    table "${noises[@]}" -- "$kind"
  done
} >>"$page.new"
mv "$page.new" "$page"
echo "$page is written."
