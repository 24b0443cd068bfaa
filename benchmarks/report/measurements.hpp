#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace croon::benchmarks {

/// What a benchmark of volume scorers measured: one line of Google Benchmark's JSON whose name is
/// `<question>/<clouds>/leaf_size_m:<size>/<scorer>`.
struct Measurement {
  std::string question;  ///< "pose", "bind", "batch" or "floor".
  std::string clouds;    ///< "carla/004069/front".
  double leaf_size_m = 0.0;
  std::string scorer;
  double time_ms = 0.0;          ///< Of one pose, or to bind; the median of the repetitions.
  std::optional<double> spread;  ///< The coefficient of variation of the repetitions.
  std::optional<double> source_points;
  std::optional<double> memory_bytes;  ///< What a bound scorer keeps.
};

/// What any other benchmark measured, whose name is `<subject>/<way>`: of a subject, such as a
/// cloud, the time by one way to do it, such as a stage.
struct PlainTime {
  std::string subject;
  std::string way;
  double time = 0.0;  ///< The median of the repetitions.
  std::string unit;   ///< Google Benchmark's word: "ms".
  std::optional<double> spread;
};

/// Where and when a run was made.
struct Machine {
  std::string date, commit, cpu;
  int cores = 0;
  double load = 0.0;  ///< Of the minute before the run.
  std::vector<std::string> caches;
};

/// One run of a benchmark program.
struct BenchmarkRun {
  std::string program;
  Machine machine;
  std::vector<Measurement> measurements;  ///< In the order of the file.
  std::vector<PlainTime> times;           ///< In the order of the file.
};

/// Reads the file that `--benchmark_out` wrote. Throws InputError if it is no such file, or a
/// benchmark in it failed.
BenchmarkRun read_run(const std::filesystem::path& file);

}  // namespace croon::benchmarks
