#include "benchmarks/report/page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "benchmarks/report/markdown.hpp"
#include "benchmarks/report/summary.hpp"
#include "benchmarks/report/times_chart.hpp"
#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::benchmarks {
namespace {

using Measurements = std::vector<const Measurement*>;

/// The measurements for which `is_wanted` is true, in order.
template <class IsWanted>
Measurements those(const BenchmarkRun& run, const IsWanted& is_wanted) {
  Measurements found;
  for (const Measurement& one : run.measurements) {
    if (is_wanted(one)) found.push_back(&one);
  }
  return found;
}

/// The distinct values of `of`, in the order of the measurements.
template <class Value, class Of>
std::vector<Value> distinct(const Measurements& measurements, const Of& of) {
  std::vector<Value> values;
  for (const Measurement* one : measurements) {
    const Value& value = std::invoke(of, *one);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

const Measurement* find(const Measurements& measurements, const std::string& clouds,
                        double leaf_size_m, const std::string& scorer) {
  for (const Measurement* one : measurements) {
    if (one->clouds == clouds && one->leaf_size_m == leaf_size_m && one->scorer == scorer) {
      return one;
    }
  }
  return nullptr;
}

std::string size_text(double leaf_size_m) { return shortest_number(leaf_size_m) + " m"; }

Measurements asking(const BenchmarkRun& run, const std::string& question) {
  return those(run, [&](const Measurement& one) { return one.question == question; });
}

double time_of(const Measurement& one) { return one.time_ms; }

/// A row for each pair of clouds and leaf size, a column for each scorer. `cell` formats a `value`,
/// given the minimum of its row.
template <class Value, class CellText>
std::string scorers_table(const Measurements& all, const Value& value, const CellText& cell) {
  if (all.empty()) return "";
  const auto scorers = distinct<std::string>(all, &Measurement::scorer);
  std::vector<std::string> titles = {"clouds, leaf size"};
  for (const std::string& scorer : scorers) titles.push_back(code(scorer));
  std::string text = header_of(titles);
  for (const std::string& clouds : distinct<std::string>(all, &Measurement::clouds)) {
    for (const double leaf_size_m : distinct<double>(all, &Measurement::leaf_size_m)) {
      double minimum = std::numeric_limits<double>::infinity();
      for (const Measurement* one : all) {
        if (one->clouds == clouds && one->leaf_size_m == leaf_size_m) {
          minimum = std::min(minimum, value(*one));
        }
      }
      if (std::isinf(minimum)) continue;
      std::vector<std::string> cells = {clouds + ", " + size_text(leaf_size_m)};
      for (const std::string& scorer : scorers) {
        const Measurement* one = find(all, clouds, leaf_size_m, scorer);
        cells.push_back(one == nullptr ? "-" : cell(value(*one), minimum));
      }
      text += row_of(cells);
    }
  }
  return text;
}

/// Three significant digits, the minimum of a row in bold.
std::string bold_if_minimum(double value, double minimum) {
  const std::string text = three_digits(value);
  return value == minimum ? "**" + text + "**" : text;
}

std::string times_table(const BenchmarkRun& run, const std::string& question) {
  return scorers_table(asking(run, question), time_of, bold_if_minimum);
}

std::string memory_table(const BenchmarkRun& run) {
  const Measurements all = those(run, [](const Measurement& one) { return one.memory_bytes; });
  return scorers_table(
      all, [](const Measurement& one) { return *one.memory_bytes / (1024.0 * 1024.0); },
      bold_if_minimum);
}

/// The time for a pose, relative to the fastest scorer.
std::string ratios_table(const BenchmarkRun& run) {
  return scorers_table(asking(run, "pose"), time_of, [](double time_ms, double best_ms) {
    return three_digits(time_ms / best_ms);
  });
}

/// The times of all scorers for a pose over `x`, for the measurements for which `is_wanted` is
/// true.
template <class IsWanted, class X>
std::vector<TimesLine> lines_over(const BenchmarkRun& run, const IsWanted& is_wanted, const X& x) {
  const Measurements all =
      those(run, [&](const Measurement& one) { return one.question == "pose" && is_wanted(one); });
  std::vector<TimesLine> lines;
  for (const std::string& scorer : distinct<std::string>(all, &Measurement::scorer)) {
    std::vector<std::pair<double, double>> points;
    for (const Measurement* one : all) {
      if (one->scorer == scorer) points.emplace_back(x(*one), one->time_ms);
    }
    std::sort(points.begin(), points.end());
    TimesLine line{scorer, {}, {}};
    for (const auto& [at, time_ms] : points) {
      line.xs.push_back(at);
      line.times_ms.push_back(time_ms);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

bool is_street(const Measurement& one) { return one.clouds.rfind("street", 0) == 0; }

/// The cost of each scorer per pose and point of the source, and its lower bounds (`floor`):
/// reading the points, and transforming them and computing the keys of their leaves.
std::string limits_table(const BenchmarkRun& run) {
  const Measurements all = asking(run, "floor");
  const Measurements floors = those(
      run, [](const Measurement& one) { return one.question == "floor" && one.scorer == "keys"; });
  if (floors.empty()) return "";
  const Measurements poses = asking(run, "pose");
  const auto scorers = distinct<std::string>(poses, &Measurement::scorer);
  std::vector<std::string> titles = {"clouds, leaf size", "points", "reading alone, ns",
                                     "keys alone, ns"};
  for (const std::string& scorer : scorers) titles.push_back(code(scorer) + ", ns");
  titles.emplace_back("fastest over keys alone");
  std::string text = header_of(titles);
  for (const Measurement* floor : floors) {
    const double points = floor->source_points.value_or(NAN);
    const auto per_point_ns = [points](const Measurement* one) {
      return one == nullptr ? "-" : three_digits(1e6 * one->time_ms / points);
    };
    std::vector<std::string> cells = {
        floor->clouds + ", " + size_text(floor->leaf_size_m), fixed_number(points, 0),
        per_point_ns(find(all, floor->clouds, floor->leaf_size_m, "reading")), per_point_ns(floor)};
    double best_ms = std::numeric_limits<double>::infinity();
    for (const std::string& scorer : scorers) {
      const Measurement* one = find(poses, floor->clouds, floor->leaf_size_m, scorer);
      cells.push_back(per_point_ns(one));
      if (one != nullptr) best_ms = std::min(best_ms, one->time_ms);
    }
    cells.push_back(three_digits(best_ms / floor->time_ms));
    text += row_of(cells);
  }
  return text;
}

using Times = std::vector<const PlainTime*>;

/// A row for each subject, a column for each way, in the order of the file.
std::string plain_table(const std::vector<Times>& rows) {
  std::vector<std::string> titles = {"", "unit"};
  for (const PlainTime* one : rows.front()) titles.push_back(code(one->way));
  std::string text = header_of(titles);
  for (const Times& row : rows) {
    std::vector<std::string> cells = {row.front()->subject, row.front()->unit};
    for (const PlainTime* one : row) cells.push_back(three_digits(one->time));
    text += row_of(cells);
  }
  return text;
}

std::vector<std::string> ways_of(const Times& row) {
  std::vector<std::string> ways;
  for (const PlainTime* one : row) ways.push_back(one->way);
  return ways;
}

/// The times of other benchmarks. Subjects with the same methods share a table.
std::string plain_tables(const BenchmarkRun& run) {
  std::vector<std::string> subjects;
  std::map<std::string, Times> rows;
  for (const PlainTime& one : run.times) {
    if (is_only_in_summary(one)) continue;
    Times& row = rows[one.subject];
    if (row.empty()) subjects.push_back(one.subject);
    row.push_back(&one);
  }
  std::vector<std::vector<Times>> tables;
  for (const std::string& subject : subjects) {
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const auto& other) {
      return ways_of(other.front()) == ways_of(rows[subject]);
    });
    if (table != tables.end()) {
      table->push_back(rows[subject]);
    } else {
      tables.push_back({rows[subject]});
    }
  }
  std::string text;
  for (const std::vector<Times>& table : tables) text += plain_table(table) + "\n";
  return text;
}

std::string machine_sentence(const BenchmarkRun& run) {
  const Machine& machine = run.machine;
  std::string text = code(run.program) + ", " + machine.date + ", commit " + machine.commit + ": " +
                     std::to_string(machine.cores) + " cores, " + machine.cpu;
  for (const std::string& cache : machine.caches) text += ", " + cache;
  text += "; load before the run " + fixed_number(machine.load, 2) + ".";
  double max_spread = 0.0;
  for (const Measurement& one : run.measurements)
    max_spread = std::max(max_spread, one.spread.value_or(0));
  for (const PlainTime& one : run.times) max_spread = std::max(max_spread, one.spread.value_or(0));
  if (max_spread > 0.0) {
    text += " The coefficient of variation of the repetitions is at most " +
            fixed_number(100.0 * max_spread, 0) + " %.";
  }
  return text + "\n\n";
}

void add_picture(Page& page, const std::string& name, const std::string& title,
                 const std::string& x_title, const std::vector<TimesLine>& lines) {
  const bool is_line = std::any_of(lines.begin(), lines.end(),
                                   [](const TimesLine& line) { return line.xs.size() > 1; });
  if (!is_line) return;
  page.markdown += "![" + title + "](pictures/" + name + ")\n\n";
  page.pictures.push_back({name, times_chart(title, x_title, lines)});
}

void add_section(Page& page, const std::string& title, const std::string& sentence,
                 const std::string& table) {
  if (table.empty()) return;
  page.markdown += "### " + title + "\n\n" + sentence + "\n\n" + table + "\n";
}

void add_run(Page& page, const BenchmarkRun& run) {
  if (run.measurements.empty() &&
      std::all_of(run.times.begin(), run.times.end(), is_only_in_summary)) {
    return;
  }
  page.markdown += "## " + code(run.program) + "\n\n" + machine_sentence(run);
  const bool has_peers =
      std::any_of(run.measurements.begin(), run.measurements.end(),
                  [](const Measurement& one) { return one.scorer.rfind("peer_", 0) == 0; });
  add_section(page, "One pose",
              "Time to score one pose with a bound scorer, ms. The fastest is bold.",
              times_table(run, "pose"));
  if (has_peers) {
    add_section(page, "Against the fastest", "The same, relative to the fastest in the row.",
                ratios_table(run));
  }
  const std::string prefix = "benchmarks_" + run.program + "_";
  add_picture(page, prefix + "points.svg", "One pose, leaves of 0.05 m, streets",
              "points of the source",
              lines_over(
                  run,
                  [](const Measurement& one) {
                    return is_street(one) && one.leaf_size_m == 0.05 && one.source_points;
                  },
                  [](const Measurement& one) { return *one.source_points; }));
  const Measurements samples = those(run, [](const Measurement& one) { return !is_street(one); });
  for (const std::string& clouds : distinct<std::string>(samples, &Measurement::clouds)) {
    std::string file = clouds;
    std::replace(file.begin(), file.end(), '/', '_');
    add_picture(page, prefix + file + ".svg", "One pose, " + clouds, "leaf size, m",
                lines_over(
                    run, [&](const Measurement& one) { return one.clouds == clouds; },
                    [](const Measurement& one) { return one.leaf_size_m; }));
  }
  add_section(
      page, "Per point, and what limits it",
      "A pose must transform every point of the source and find the key of its leaf: 12 bytes "
      "read, 18 multiplications and additions and three keys per point. Reading alone is limited "
      "by memory: 12 bytes divided by its time is the bandwidth. Keys alone, computed with the "
      "same code, are the lower bound; the rest is the table of leaves.",
      limits_table(run));
  add_section(page, "Many poses",
              "Time per pose in a batch of 64, which a scorer may distribute over all cores, ms.",
              times_table(run, "batch"));
  add_section(page, "To bind", "Time to bind a scorer to two new clouds, ms.",
              times_table(run, "bind"));
  add_section(page, "Memory",
              "Memory of a scorer bound to two clouds, or of the tree that a peer builds from both "
              "at a pose, MiB, without their points.",
              memory_table(run));
  page.markdown += plain_tables(run);
}

}  // namespace

Page page_of(const std::vector<BenchmarkRun>& runs, const std::string& date) {
  Page page;
  page.markdown = "# " + date +
                  ": What does each part cost?\n\n`benchmarks/report.sh` wrote this page, beside "
                  "[docs/benchmarks.md](../benchmarks.md), which has the comparisons with other "
                  "libraries and whole calibrations. Times are medians of wall time.\n\n";
  for (const BenchmarkRun& run : runs) add_run(page, run);
  while (page.markdown.size() > 1 && page.markdown[page.markdown.size() - 2] == '\n') {
    page.markdown.pop_back();
  }
  return page;
}

}  // namespace croon::benchmarks
