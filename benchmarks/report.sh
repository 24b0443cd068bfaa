#!/usr/bin/env bash
# Runs all benchmarks that are built and writes a dated page of docs/notebook and its pictures. The machine should do nothing
# else.
# Usage: CROON_DATA=data benchmarks/report.sh BUILD [NOTEBOOK]
# With CROON_BENCHMARK_POINTS=10000000 up to so many points; with -DCROON_BENCHMARK_PEERS=ON other libraries too.
set -euo pipefail

build=$1
notebook=${2:-$(dirname "$0")/../docs/notebook}
files=()
for program in "$build"/bin/bench_*; do
  file=$build/$(basename "$program").json
  "$program" --benchmark_repetitions="${REPETITIONS:-5}" --benchmark_report_aggregates_only=true \
    --benchmark_min_time="${MIN_TIME:-0.05}" --benchmark_out_format=json --benchmark_out="$file" \
    --benchmark_context="commit=$(git -C "$(dirname "$0")" describe --always --dirty)" \
    --benchmark_context="cpu=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -1 | tr -d ,)"
  files+=("$file")
done
"$build/bin/benchmark_report" "$notebook" "${files[@]}"
{
  echo "# $(date +%F): What does each part cost?"
  tail -n +2 "$notebook/benchmarks.md"
} >"$notebook/$(date +%F)-what-each-part-costs.md"
rm "$notebook/benchmarks.md"
