#include "benchmarks/report/summary.hpp"

#include <algorithm>
#include <optional>

#include "benchmarks/report/markdown.hpp"
#include "framework/base/text.hpp"

namespace croon::benchmarks {
namespace {

constexpr const char* kCalibration = "calibration/";
constexpr const char* kGrowth = "growth/";
constexpr const char* kProgram = "program/";
constexpr const char* kOneCore = "_one_core";
constexpr double kMiB = 1024.0 * 1024.0;

bool starts(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

bool ends(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// A time with its unit.
std::string time_text(double ms) {
  if (ms >= 1000.0) return three_digits(ms / 1000.0) + " s";
  if (ms >= 1.0) return three_digits(ms) + " ms";
  return ms >= 1e-3 ? three_digits(1e3 * ms) + " µs" : three_digits(1e6 * ms) + " ns";
}

/// The time with one method.
struct Way {
  std::string name;
  double ms = 0.0;
  bool is_peer() const { return starts(name, "peer_"); }
  bool is_on_one_core() const { return ends(name, kOneCore); }
};

/// The times for one subject on one pair of clouds, in one run.
struct Comparison {
  std::string what, clouds;
  std::vector<Way> ways;

  bool has_peer() const {
    return std::any_of(ways.begin(), ways.end(), [](const Way& way) { return way.is_peer(); });
  }
  /// Ours with which `peer` is compared: on one core, if the peer is; the fastest of several.
  const Way* ours(const Way& peer) const {
    const Way* best = nullptr;
    for (const Way& way : ways) {
      if (way.is_peer()) continue;
      const bool fits = peer.is_on_one_core() == way.is_on_one_core();
      const bool best_fits = best != nullptr && peer.is_on_one_core() == best->is_on_one_core();
      if (best == nullptr || (fits && !best_fits) || (fits == best_fits && way.ms < best->ms)) {
        best = &way;
      }
    }
    return best;
  }
};

void add_way(std::vector<Comparison>& all, const std::string& what, const std::string& clouds,
             const Way& way) {
  auto place = std::find_if(all.begin(), all.end(), [&](const Comparison& one) {
    return one.what == what && one.clouds == clouds;
  });
  if (place == all.end()) place = all.insert(all.end(), {what, clouds, {}});
  place->ways.push_back(way);
}

/// What has a peer, other than whole calibrations. Never mixes two runs.
std::vector<Comparison> comparisons_of(const std::vector<BenchmarkRun>& runs) {
  std::vector<Comparison> all;
  for (const BenchmarkRun& run : runs) {
    std::vector<Comparison> of_run;
    for (const PlainTime& one : run.times) {
      const std::size_t slash = one.subject.find('/');
      if (slash == std::string::npos || is_only_in_summary(one)) continue;
      add_way(of_run, one.subject.substr(0, slash), one.subject.substr(slash + 1),
              {one.way, one.time_ms()});
    }
    for (const Measurement& one : run.measurements) {
      if (one.question != "pose") continue;
      add_way(of_run, "volume of a pose, leaves of " + shortest_number(one.leaf_size_m) + " m",
              one.clouds, {one.scorer, one.time_ms});
    }
    for (Comparison& one : of_run) {
      if (one.has_peer() && one.ours(one.ways.back()) != nullptr) all.push_back(std::move(one));
    }
  }
  return all;
}

/// "`open3d` 68 ms (6.3 ×)"
std::string peer_text(const Comparison& comparison, const Way& peer) {
  std::string name = peer.name.substr(std::string("peer_").size());
  const bool is_on_one_core = peer.is_on_one_core();
  if (is_on_one_core) name.resize(name.size() - std::string(kOneCore).size());
  return code(name) + " " + time_text(peer.ms) + (is_on_one_core ? " on one core (" : " (") +
         three_digits(peer.ms / comparison.ours(peer)->ms) + " ×)";
}

/// "`brick_hash` 67 µs"; the name is omitted if it says nothing.
std::string our_text(const Way& way) {
  const std::string time = time_text(way.ms);
  if (way.name == "croon") return time;
  if (way.name == std::string("croon") + kOneCore) return time + " on one core";
  return code(way.name) + " " + time;
}

/// The row of the first pair of recorded clouds with all of their points, else of the last pair.
const Comparison& typical(const std::vector<const Comparison*>& same) {
  const auto is_street = [](const Comparison* one) { return starts(one->clouds, "street"); };
  const auto with_ground = std::find_if(same.begin(), same.end(), [](const Comparison* one) {
    return ends(one->clouds, "_with_ground");
  });
  if (with_ground != same.end()) return **with_ground;
  const auto recorded = std::find_if_not(same.begin(), same.end(), is_street);
  return recorded != same.end() ? **recorded : *same.back();
}

std::string comparison_row(const Comparison& one) {
  std::vector<const Way*> used;
  std::string peers, ours;
  for (const Way& way : one.ways) {
    if (!way.is_peer()) continue;
    peers += (peers.empty() ? "" : ", ") + peer_text(one, way);
    const Way* own = one.ours(way);
    if (std::find(used.begin(), used.end(), own) == used.end()) used.push_back(own);
  }
  for (const Way* own : used) ours += (ours.empty() ? "" : ", ") + our_text(*own);
  std::string what = one.what;
  std::replace(what.begin(), what.end(), '_', ' ');
  return row_of({what, one.clouds, ours, peers});
}

/// How often we are faster than a peer, and each peer that is faster than we are.
std::string verdict(const std::vector<Comparison>& all) {
  int faster = 0, count = 0;
  std::string slower;
  for (const Comparison& one : all) {
    for (const Way& peer : one.ways) {
      if (!peer.is_peer()) continue;
      ++count;
      const double ratio = peer.ms / one.ours(peer)->ms;
      if (ratio >= 1.0) {
        ++faster;
      } else {
        slower += (slower.empty() ? "" : ", ") + one.what + " of " + one.clouds + " (" +
                  code(peer.name.substr(5)) + ", " + three_digits(ratio) + " ×)";
      }
    }
  }
  return "croon is faster in " + std::to_string(faster) + " of " + std::to_string(count) +
         " comparisons on all clouds" + (slower.empty() ? "" : "; slower in: " + slower) + ".\n\n";
}

std::string peers_section(const std::vector<BenchmarkRun>& runs) {
  const std::vector<Comparison> all = comparisons_of(runs);
  if (all.empty()) return "";
  std::string text =
      "## croon and other libraries\n\nIn parentheses: the time over croon's, on the same number "
      "of "
      "cores where both are given. " +
      verdict(all) + "| what | clouds | croon | others |\n|---|---|---|---|\n";
  std::vector<std::string> done;
  for (const Comparison& one : all) {
    if (std::find(done.begin(), done.end(), one.what) != done.end()) continue;
    done.push_back(one.what);
    std::vector<const Comparison*> same;
    for (const Comparison& other : all) {
      if (other.what == one.what) same.push_back(&other);
    }
    text += comparison_row(typical(same));
  }
  return text + "\n";
}

using Times = std::vector<const PlainTime*>;

Times below(const std::vector<BenchmarkRun>& runs, const std::string& start) {
  Times found;
  for (const BenchmarkRun& run : runs) {
    for (const PlainTime& one : run.times) {
      if (starts(one.subject, start)) found.push_back(&one);
    }
  }
  return found;
}

std::optional<double> counter(const PlainTime& one, const std::string& name) {
  const auto place = one.counters.find(name);
  return place == one.counters.end() ? std::nullopt : std::optional<double>(place->second);
}

/// ", 0.0168°, 1.24 mm"
std::string error_text(const PlainTime& one, const std::string& prefix) {
  const std::optional<double> rotation_deg = counter(one, prefix + "rotation_deg");
  const std::optional<double> translation_m = counter(one, prefix + "translation_m");
  if (!rotation_deg || !translation_m) return "";
  return ", " + three_digits(*rotation_deg) + "°, " + three_digits(1000.0 * *translation_m) + " mm";
}

std::string share_text(const PlainTime& one, const std::string& name, const std::string& word) {
  const double ratio = counter(one, name).value_or(0.0);
  return ratio > 0.0 ? ", **" + fixed_number(100.0 * ratio, 0) + " % " + word + "**" : "";
}

/// A peer's time is also relative to `best_ms`, that of `croon_best`, if it is not zero.
std::string calibration_cell(const PlainTime& one, double best_ms) {
  const bool has_ratio = starts(one.way, "peer_") && best_ms > 0.0;
  const std::string ratio =
      has_ratio ? " (" + three_digits(one.time_ms() / best_ms) + " ×)" : std::string();
  return time_text(one.time_ms()) + ratio + error_text(one, "") +
         share_text(one, "wrong_ratio", "wrong") + share_text(one, "rejected_ratio", "rejected");
}

std::string calibrations_section(const std::vector<BenchmarkRun>& runs) {
  const Times all = below(runs, kCalibration);
  if (all.empty()) return "";
  std::vector<std::string> titles = {"clouds"}, subjects;
  for (const PlainTime* one : all) {
    if (one->subject == all.front()->subject) titles.push_back(code(one->way));
    if (subjects.empty() || subjects.back() != one->subject) subjects.push_back(one->subject);
  }
  std::string text =
      "## A calibration of two clouds\n\nWith everything from the points to the pose; median "
      "errors "
      "to the pose that is known (of `real` and `edgar` the nominal one, good to 0.3° and 3 cm, "
      "and "
      "6 cm). Wrong: beyond 0.5° or 0.1 m and not rejected. Only `croon_paper` gets an initial "
      "guess, within 45°.\n\n" +
      header_of(titles);
  for (const std::string& subject : subjects) {
    std::vector<std::string> cells = {subject.substr(std::string(kCalibration).size())};
    double best_ms = 0.0;
    for (const PlainTime* one : all) {
      if (one->subject != subject) continue;
      if (one->way == "croon_best") best_ms = one->time_ms();
      cells.push_back(calibration_cell(*one, best_ms));
    }
    text += row_of(cells);
  }
  return text + "\n";
}

std::string growth_section(const std::vector<BenchmarkRun>& runs) {
  std::vector<std::string> points = {"points of both clouds"}, times = {"time"},
                           each = {"per point"};
  for (const PlainTime* one : below(runs, kGrowth)) {
    const double count = counter(*one, "points").value_or(0.0);
    points.push_back(fixed_number(count, 0));
    times.push_back(time_text(one->time_ms()));
    each.push_back(count > 0.0 ? time_text(one->time_ms() / count) : "-");
  }
  if (times.size() == 1) return "";
  return "## More points\n\n`best.json` without an initial guess, on simulated streets.\n\n" +
         header_of(points) + row_of(times) + row_of(each) + "\n";
}

std::string program_section(const std::vector<BenchmarkRun>& runs) {
  const Times all = below(runs, kProgram);
  if (all.empty()) return "";
  std::string text =
      "## The program\n\n`croon calibrate --jobs 2` of five sensors in one scene, from the start "
      "of "
      "the process; the largest errors of the rig.\n\n" +
      header_of({"clouds", "points", "writes", "time and errors", "peak memory"});
  for (const PlainTime* one : all) {
    std::string writes = one->way;
    std::replace(writes.begin(), writes.end(), '_', ' ');
    text += row_of({one->subject.substr(std::string(kProgram).size()),
                    fixed_number(counter(*one, "points").value_or(0.0), 0), writes,
                    time_text(one->time_ms()) + error_text(*one, "max_"),
                    three_digits(counter(*one, "peak_bytes").value_or(0.0) / kMiB) + " MiB"});
  }
  return text + "\n";
}

double max_spread(const BenchmarkRun& run) {
  double spread = 0.0;
  for (const Measurement& one : run.measurements) spread = std::max(spread, one.spread.value_or(0));
  for (const PlainTime& one : run.times) spread = std::max(spread, one.spread.value_or(0));
  return spread;
}

/// All in one paragraph, because a page of docs has to be short.
std::string programs_section(const std::vector<BenchmarkRun>& runs, const std::string& tables) {
  std::string list;
  for (const BenchmarkRun& run : runs) {
    list += (list.empty() ? "" : "; ") + code(run.program) + " (" + run.machine.commit + ", " +
            std::to_string(run.times.size() + run.measurements.size()) + " times, load " +
            fixed_number(run.machine.load, 2) + ", " + fixed_number(100.0 * max_spread(run), 0) +
            " %)";
  }
  return "## Every program\n\nAll other times are [in the notebook](" + tables +
         "). With the commit, the load before the run, and the largest coefficient of variation of "
         "the repetitions: " +
         list + ".\n";
}

}  // namespace

bool is_only_in_summary(const PlainTime& time) {
  return starts(time.subject, kCalibration) || starts(time.subject, kGrowth) ||
         starts(time.subject, kProgram);
}

std::string summary_of(const std::vector<BenchmarkRun>& runs, const std::string& tables) {
  const Machine machine = runs.empty() ? Machine{} : runs.front().machine;
  std::string text =
      "# Benchmarks\n\n`benchmarks/report.sh` wrote this page; "
      "[benchmarks](../benchmarks/README.md) "
      "describes what each program measures and verifies first. Times are medians of wall time, "
      "measured on " +
      machine.date.substr(0, 10) + " on " + std::to_string(machine.cores) + " cores, " +
      machine.cpu;
  for (const std::string& cache : machine.caches) text += ", " + cache;
  return text + ".\n\n" + peers_section(runs) + calibrations_section(runs) + growth_section(runs) +
         program_section(runs) + programs_section(runs, tables);
}

}  // namespace croon::benchmarks
