#include "benchmarks/report/measurements.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::benchmarks {
namespace {

using nlohmann::json;

double in_ms(double time, const std::string& unit) {
  static const std::map<std::string, double> ms = {
      {"ns", 1e-6}, {"us", 1e-3}, {"ms", 1.0}, {"s", 1e3}};
  return time * ms.at(unit);
}

/// The name without Google Benchmark's suffixes.
std::string own_name(const std::string& name) {
  static const std::regex ending("/(real|manual)_time$");
  return std::regex_replace(name, ending, "");
}

/// The parts of a name; std::nullopt for a benchmark of another form.
std::optional<Measurement> measurement_of(const std::string& name) {
  static const std::regex pattern(R"(^(pose|bind|batch|floor)/(.+)/leaf_size_m:([0-9.]+)/(\w+)$)");
  std::smatch match;
  if (!std::regex_match(name, match, pattern)) return std::nullopt;
  Measurement measurement;
  measurement.question = match[1];
  measurement.clouds = match[2];
  measurement.leaf_size_m = std::stod(match[3]);
  measurement.scorer = match[4];
  return measurement;
}

PlainTime plain_time_of(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  PlainTime time;
  if (slash != std::string::npos) time.subject = name.substr(0, slash);
  time.way = slash == std::string::npos ? name : name.substr(slash + 1);
  return time;
}

Machine machine_of(const json& context) {
  Machine machine;
  machine.date = context.at("date");
  machine.cores = context.at("num_cpus");
  machine.commit = context.value("commit", "unknown");
  machine.cpu = context.value("cpu", "unknown");
  const json load = context.value("load_avg", json::array());
  if (!load.empty()) machine.load = load[0];
  for (const json& cache : context.value("caches", json::array())) {
    if (cache.at("type") == "Instruction") continue;
    machine.caches.push_back("L" + std::to_string(cache.at("level").get<int>()) + " " +
                             std::to_string(cache.at("size").get<long>() / 1024) + " KiB");
  }
  return machine;
}

/// Whether the line has the coefficient of variation; with repetitions there is also one with the
/// median.
bool is_spread(const json& line) { return line.value("aggregate_name", "") == "cv"; }
bool is_time(const json& line) {
  const std::string aggregate = line.value("aggregate_name", "");
  return aggregate.empty() || aggregate == "median";
}

void add_line(const json& line, Measurement& measurement) {
  if (is_spread(line)) measurement.spread = line.at("real_time").get<double>();
  if (!is_time(line)) return;
  measurement.time_ms = in_ms(line.at("real_time"), line.at("time_unit"));
  if (line.contains("poses")) measurement.time_ms /= line.at("poses").get<double>();
  if (line.contains("source_points")) measurement.source_points = line.at("source_points");
  if (line.contains("memory_bytes")) measurement.memory_bytes = line.at("memory_bytes");
}

/// Adds the counters of a line with a median, a mean or a single value.
void add_counters(const json& line, PlainTime& time) {
  const bool is_mean = line.value("aggregate_name", "mean") == "mean";
  for (const char* name : {"points", "peak_bytes", "rotation_deg", "translation_m",
                           "max_rotation_deg", "max_translation_m"}) {
    if (is_time(line) && line.contains(name)) time.counters[name] = line.at(name);
  }
  for (const char* name : {"wrong_ratio", "rejected_ratio"}) {
    if (is_mean && line.contains(name)) time.counters[name] = line.at(name);
  }
}

void add_line(const json& line, PlainTime& time) {
  if (is_spread(line)) time.spread = line.at("real_time").get<double>();
  add_counters(line, time);
  if (!is_time(line)) return;
  time.time = line.at("real_time");
  time.unit = line.at("time_unit");
}

/// Adds a line to the entry with its name in `list`; `entry` is the initial entry of a new name.
template <class Entry>
void add_to(std::vector<Entry>& list, std::map<std::string, std::size_t>& places,
            const std::string& name, const Entry& entry, const json& line) {
  const auto [place, is_new] = places.emplace(name, list.size());
  if (is_new) list.push_back(entry);
  add_line(line, list[place->second]);
}

BenchmarkRun run_of(const json& content, const std::string& file) {
  BenchmarkRun run;
  const json& context = content.at("context");
  run.program = std::filesystem::path(context.at("executable").get<std::string>()).filename();
  run.machine = machine_of(context);
  std::map<std::string, std::size_t> places, plain_places;
  for (const json& line : content.at("benchmarks")) {
    const std::string name = own_name(line.at("run_name"));
    if (line.value("error_occurred", false)) {
      throw InputError(file, name, "the benchmark failed: " + line.value("error_message", ""));
    }
    if (const std::optional<Measurement> measurement = measurement_of(name)) {
      add_to(run.measurements, places, name, *measurement, line);
    } else {
      add_to(run.times, plain_places, name, plain_time_of(name), line);
    }
  }
  return run;
}

}  // namespace

double PlainTime::time_ms() const { return in_ms(time, unit); }

BenchmarkRun read_run(const std::filesystem::path& file) {
  // Google Benchmark writes the coefficient of variation of a counter that is zero as NaN.
  static const std::regex no_number(R"(": -?(NaN|Infinity))");
  const std::string text = std::regex_replace(read_whole_file(file), no_number, "\": null");
  try {
    return run_of(json::parse(text), file.string());
  } catch (const json::exception& error) {
    throw InputError(file.string(), "",
                     std::string("expected a file from --benchmark_out: ") + error.what());
  }
}

}  // namespace croon::benchmarks
