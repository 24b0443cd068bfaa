#!/usr/bin/env bash
# Runs all benchmarks that are built and writes docs/benchmarks.md, and a dated page of docs/notebook with all tables and its
# pictures instead of the last one. The machine should do nothing else.
# Usage: CROON_DATA=data benchmarks/report.sh BUILD [DOCS]
# With CROON_BENCHMARK_POINTS=10000000 up to so many points; with -DCROON_BENCHMARK_PEERS=ON other libraries too.
set -euo pipefail

build=$1
docs=${2:-$(dirname "$0")/../docs}
files=()
for program in "$build"/bin/bench_*; do
  file=$build/$(basename "$program").json
  "$program" --benchmark_repetitions="${REPETITIONS:-5}" --benchmark_report_aggregates_only=true \
    --benchmark_min_time="${MIN_TIME:-0.05}" --benchmark_out_format=json --benchmark_out="$file" \
    --benchmark_context="commit=$(git -C "$(dirname "$0")" describe --always --dirty)" \
    --benchmark_context="cpu=$(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -1 | tr -d ,)"
  files+=("$file")
done
date=$(date +%F)
mkdir -p "$docs/notebook/pictures"
rm -f "$docs"/notebook/*-what-each-part-costs.md
"$build/bin/benchmark_report" "$docs" "$date" "${files[@]}"
index=$docs/notebook/README.md
if [[ -f $index ]]; then
  sed -i -E "s/\[[0-9-]+: what each part costs\]\([0-9-]+-what/[$date: what each part costs]($date-what/" "$index"
fi
