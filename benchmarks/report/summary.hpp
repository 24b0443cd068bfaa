#pragma once

#include <string>
#include <vector>

#include "benchmarks/report/measurements.hpp"

namespace croon::benchmarks {

/// The page docs/benchmarks.md: the runs with other libraries, whole calibrations, and a line for
/// each program. `tables` is the path of the page with all other tables, relative to docs.
std::string summary_of(const std::vector<BenchmarkRun>& runs, const std::string& tables);

/// Whether the summary has all of a benchmark, so that no other page repeats it.
bool is_only_in_summary(const PlainTime& time);

}  // namespace croon::benchmarks
