#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace croon::benchmarks {

/// The result of a benchmark of volume scorers: one line of Google Benchmark's JSON named
/// `<question>/<clouds>/leaf_size_m:<size>/<scorer>`.
struct Measurement {
  std::string question;  ///< "pose", "bind", "batch" or "floor".
  std::string clouds;    ///< "carla/004069/front".
  double leaf_size_m = 0.0;
  std::string scorer;
  double time_ms = 0.0;          ///< For one pose, or for binding; the median of the repetitions.
  std::optional<double> spread;  ///< The coefficient of variation of the repetitions.
  std::optional<double> source_points;
  std::optional<double> memory_bytes;  ///< Memory of a bound scorer.
};

/// The result of any other benchmark, named `<subject>/<way>`: the time for a subject, such as a
/// cloud, with one method, such as a stage.
struct PlainTime {
  std::string subject;
  std::string way;
  double time = 0.0;  ///< The median of the repetitions.
  std::string unit;   ///< As in Google Benchmark: "ms".
  std::optional<double> spread;
  /// Counters by name: "points", "rotation_deg". Medians of the repetitions; of ratios the means.
  std::map<std::string, double> counters;

  double time_ms() const;
};

/// The machine and date of a run.
struct Machine {
  std::string date, commit, cpu;
  int cores = 0;
  double load = 0.0;  ///< Average over the minute before the run.
  std::vector<std::string> caches;
};

/// One run of a benchmark program.
struct BenchmarkRun {
  std::string program;
  Machine machine;
  std::vector<Measurement> measurements;  ///< In the order of the file.
  std::vector<PlainTime> times;           ///< In the order of the file.
};

/// Reads a file written by `--benchmark_out`. Throws InputError if it is invalid, or if a benchmark
/// in it failed.
BenchmarkRun read_run(const std::filesystem::path& file);

}  // namespace croon::benchmarks
