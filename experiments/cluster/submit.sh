#!/usr/bin/env bash
# Submits an experiment to Slurm: an array of N shards, and a job that merges them into OUT when all are done.
# Usage: submit.sh EXPERIMENT OUT N [options of sbatch for the array, such as --cpus-per-task=8 --time=2:00:00]
# Options of both jobs (partition, account) are best set as SBATCH_PARTITION and SBATCH_ACCOUNT.
set -euo pipefail

if [[ $# -lt 3 || ! $3 =~ ^[1-9][0-9]*$ ]]; then
  echo 'Usage: submit.sh EXPERIMENT OUT N [options of sbatch]' >&2
  exit 2
fi
experiment=$1 out=$2 shards=$3
shift 3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mkdir -p "$out/log"
# Slurm takes a percent sign in a path for a pattern unless it is doubled.
logs=${out//%/%%}/log

# N is told, so that some tasks of the array can be submitted again with the same shards.
export CROON_SHARDS=$shards
array=$(sbatch --parsable --array="0-$((shards - 1))" --output="$logs/task.%a.log" "$@" \
  "$here/slurm_array.sh" "$experiment" "$out")
array=${array%%;*}

merge=("${CROON:-croon}" merge)
for ((shard = 1; shard <= shards; ++shard)); do merge+=("$out/shard.$shard"); done
merge+=(--out "$out")
# A shard that cannot be done takes the merge out of the queue, else it would wait there for ever.
job=$(printf '#!/usr/bin/env bash\n%s\n' "$(printf '%q ' "${merge[@]}")" |
  sbatch --parsable --job-name=croon-merge --output="$logs/merge.log" \
    --dependency="afterok:$array" --kill-on-invalid-dep=yes)
echo "Shards are job $array, the merge is job ${job%%;*}; logs are in $out/log"
