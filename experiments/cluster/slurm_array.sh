#!/usr/bin/env bash
# One shard of an experiment, as a task of a Slurm array: task i of N runs shard i+1 of N into OUT/shard.<i+1>.
# Usage: sbatch --array=0-3 slurm_array.sh EXPERIMENT OUT [options of croon run]
# A task that is requeued or submitted again goes on where it was. The data root is CROON_DATA, the program
# CROON (default: croon on the path). CROON_SHARDS is N where only some tasks of an array are submitted again.
#SBATCH --job-name=croon
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail

if [[ $# -lt 2 || -z ${SLURM_ARRAY_TASK_ID:-} ]]; then
  echo 'Usage: sbatch --array=0-<N-1> slurm_array.sh EXPERIMENT OUT [options of croon run]' >&2
  exit 2
fi
experiment=$1 out=$2
shift 2
shard=$((SLURM_ARRAY_TASK_ID + 1))
shards=${CROON_SHARDS:-$SLURM_ARRAY_TASK_COUNT}

run_shard() {
  "${CROON:-croon}" run "$experiment" --shard "$shard/$shards" --out "$out/shard.$shard" \
    --jobs "${SLURM_CPUS_PER_TASK:-1}" --quiet "$@"
}
status=0
run_shard "$@" || status=$?
# With 3 some trial failed, or its files could not be read just then. A second run runs the latter alone. A trial that
# failed is a result like any other, which must not keep the others from being merged; croon merge says it again.
if [[ $status -eq 3 ]]; then
  status=0
  run_shard "$@" || status=$?
fi
if [[ $status -eq 3 ]]; then exit 0; fi
exit "$status"
