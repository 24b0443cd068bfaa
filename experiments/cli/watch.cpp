#include "experiments/cli/watch.hpp"

#include <tbb/info.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "experiments/cli/options.hpp"
#include "framework/base/error.hpp"
#include "framework/base/progress.hpp"
#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/calibration/audit.hpp"
#include "framework/calibration/drift_test.hpp"
#include "framework/calibration/pairing.hpp"
#include "framework/calibration/scene_stream.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {
namespace {

constexpr double kScansPerHour = 36000.0;
constexpr double kDefaultFalseAlarmEvery_h = 10.0;
constexpr double kDefaultTimeGap_s = 0.05;

std::atomic<bool> is_stopped{false};

/// Ends the watch after the current scan while it exists.
class StopSignals {
 public:
  StopSignals() {
    is_stopped = false;
    interrupt_ = std::signal(SIGINT, stop);
    terminate_ = std::signal(SIGTERM, stop);
  }
  ~StopSignals() {
    std::signal(SIGINT, interrupt_);
    std::signal(SIGTERM, terminate_);
  }
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

 private:
  static void stop(int) { is_stopped = true; }

  void (*interrupt_)(int);
  void (*terminate_)(int);
};

/// A sensor that is watched.
struct WatchedSensor {
  std::string name;
  DriftTest test;
  std::string why_not = {};      ///< Of the last scan.
  SensorAudit audit = {};        ///< Likewise.
  DriftTest::Change drift = {};  ///< The one that was printed last.
  std::size_t scans = 0, usable = 0;
};

/// One row of the log.
struct WatchRow {
  std::size_t scan = 0;
  std::string scene;
  std::optional<double> time_s;
  const WatchedSensor* sensor = nullptr;
};

std::string offset_text(Dof dof, double value, bool has_sign) {
  const std::string sign = !has_sign ? "" : value < 0.0 ? "-" : "+";
  return is_rotation(dof) ? sign + fixed_number(deg_from_rad(std::abs(value)), 2) + "°"
                          : sign + fixed_number(1e3 * std::abs(value), 0) + " mm";
}

/// "yaw +0.21° ± 0.03°".
std::string change_text(const DriftTest::Change& change) {
  return kDofNames.at(static_cast<std::size_t>(change.dof)) + " " +
         offset_text(change.dof, change.size, true) + " ± " +
         offset_text(change.dof, change.deviation, false);
}

/// The columns of the log; angles in degrees.
Columns<WatchRow> log_columns() {
  Columns<WatchRow> columns;
  columns.add({"scan"}, [](const WatchRow& row) { return static_cast<long long>(row.scan); });
  columns.add({"scene"}, &WatchRow::scene);
  columns.add({"time", "s"}, &WatchRow::time_s);
  columns.add({"sensor"}, [](const WatchRow& row) { return row.sensor->name; });
  columns.add({"verdict"},
              [](const WatchRow& row) { return std::string(name_of(row.sensor->test.state())); });
  columns.add({"why_not"}, [](const WatchRow& row) { return row.sensor->why_not; });
  for (int i = 0; i < 6; ++i) {
    const bool is_angle = is_rotation(static_cast<Dof>(i));
    const std::string name = kDofNames.at(static_cast<std::size_t>(i));
    const char* const unit = is_angle ? "deg" : "m";
    const double factor = is_angle ? deg_from_rad(1.0) : 1.0;
    const auto add = [&](const std::string& column, const char* column_unit, const auto& value) {
      columns.add({column, column_unit}, [value](const WatchRow& row) {
        return row.sensor->why_not.empty() ? std::make_optional(value(*row.sensor)) : std::nullopt;
      });
    };
    add(name, unit, [=](const WatchedSensor& s) { return factor * s.audit.difference(i); });
    add(name + "_std", unit,
        [=](const WatchedSensor& s) { return factor * std::sqrt(s.audit.covariance(i, i)); });
    add(name + "_statistic", "", [=](const WatchedSensor& s) { return s.test.statistics()(i); });
  }
  columns.add({"threshold"}, [](const WatchRow& row) { return row.sensor->test.threshold(); });
  return columns;
}

/// The log, flushed after each scan; does nothing without a file.
class WatchLog {
 public:
  explicit WatchLog(const std::optional<std::filesystem::path>& file) : columns_(log_columns()) {
    if (!file) return;
    name_ = file->string();
    if (std::filesystem::exists(std::filesystem::symlink_status(*file))) {
      throw InputError(name_, "--log", "expected a new file, found one that exists");
    }
    stream_.open(*file, std::ios::binary);
    write(csv_header(columns_.columns()));
  }

  void add(const std::vector<WatchRow>& rows) {
    if (name_.empty()) return;
    std::string bytes;
    for (const WatchRow& row : rows) bytes += csv_line(columns_.columns(), columns_.cells(row));
    write(bytes);
  }

 private:
  void write(const std::string& bytes) {
    stream_ << bytes << std::flush;
    if (!stream_) throw InputError(name_, "--log", "cannot be written");
  }

  Columns<WatchRow> columns_;
  std::string name_;
  std::ofstream stream_;
};

/// The stream of the scenes in the inputs.
SceneStream stream_of(const CalibrateOptions& options) {
  RecordingOptions recording;
  recording.reference = options.reference;
  recording.max_time_gap_s = options.max_time_gap_s.value_or(kDefaultTimeGap_s);
  recording.max_scenes = std::numeric_limits<int>::max();
  return {recorded_scenes(options.inputs, recording), recording.max_time_gap_s};
}

class Watch {
 public:
  Watch(const WatchOptions& options, std::ostream& out, std::ostream& err)
      : options_(options), out_(out), err_(err), stream_(stream_of(options)), log_(check_poses()) {}

  int run() {
    const StopSignals signals;
    const int jobs = options_.jobs > 0 ? options_.jobs : tbb::info::default_concurrency();
    on_threads(jobs, [&] { watch_all(); });
    print_end();
    const auto is = [&](DriftState state) {
      return std::any_of(sensors_.begin(), sensors_.end(),
                         [&](const WatchedSensor& sensor) { return sensor.test.state() == state; });
    };
    return is(DriftState::drifted) || !is(DriftState::right) ? 3 : 0;
  }

 private:
  /// Reads the poses of the sensors, and returns the name of the log.
  const std::optional<std::filesystem::path>& check_poses() {
    std::vector<Scene> scenes(1);
    scenes.front().reference.sensor = stream_.reference();
    for (const std::string& name : stream_.sensors()) {
      SensorScan scan;
      scan.sensor = name;
      scenes.front().sensors.push_back(scan);
    }
    for (const std::string& line : set_nominal(scenes, options_.nominal)) {
      out_ << "warning: " << printable(line) << "\n";
    }
    std::vector<RigidTransform> given;
    for (const SensorScan& scan : scenes.front().sensors) {
      if (!scan.nominal) continue;
      given.push_back(*scan.nominal);
      sensors_.push_back({scan.sensor, DriftTest()});
    }
    const double hours = options_.false_alarm_every_h.value_or(kDefaultFalseAlarmEvery_h);
    DriftTestOptions test;
    test.threshold = drift_threshold(hours * kScansPerHour, 6 * static_cast<int>(sensors_.size()));
    for (WatchedSensor& sensor : sensors_) sensor.test = DriftTest(test);
    auditor_.emplace(std::move(given), options_.at_rest);
    return options_.log;
  }

  void watch_all() {
    using Clock = std::chrono::steady_clock;
    constexpr auto kPoll = std::chrono::milliseconds(50);
    Progress progress(err_, progress_style_of_stderr(options_.quiet || stream_.is_growing()),
                      stream_.size().value_or(1));
    auto last = Clock::now();
    while (!is_stopped) {
      std::optional<Scene> scene = stream_.next();
      if (scene) {
        watch(*scene);
        progress.advance();
        last = Clock::now();
        continue;
      }
      if (!stream_.is_growing()) return;
      const double idle_s = std::chrono::duration<double>(Clock::now() - last).count();
      if (options_.until_idle_s && idle_s >= *options_.until_idle_s) return;
      std::this_thread::sleep_for(kPoll);
    }
  }

  void watch(const Scene& scene) {
    const std::optional<double> stamp_s = stamp_in_name(scene.name);
    if (!first_stamp_s_) first_stamp_s_ = stamp_s;
    const std::optional<double> time_s =
        stamp_s && first_stamp_s_ ? std::make_optional(*stamp_s - *first_stamp_s_) : std::nullopt;
    ReadScan reference;
    std::vector<std::optional<ReadScan>> scans(sensors_.size());
    for_each_in_parallel(sensors_.size() + 1, [&](std::size_t i) {
      if (i == sensors_.size()) {
        reference = read_scan(scene.reference);
        return;
      }
      const std::size_t in_scene = index_of(scene, sensors_[i].name);
      if (in_scene < scene.sensors.size()) scans[i] = read_scan(scene.sensors[in_scene]);
    });
    std::vector<SensorAudit> audits(sensors_.size());
    try {
      audits = auditor_->audit(std::move(reference), std::move(scans), stamp_s);
    } catch (const StageError& error) {
      for (SensorAudit& audit : audits) audit.why_not = error.what();
    }
    std::vector<WatchRow> rows;
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      note(sensors_[i], audits[i], time_s);
      rows.push_back({scan_, scene.name, time_s, &sensors_[i]});
    }
    log_.add(rows);
    ++scan_;
  }

  /// Adds the audit of a scan to the test of its sensor, and prints a change of the verdict.
  void note(WatchedSensor& sensor, const SensorAudit& audit, std::optional<double> time_s) {
    const DriftState before = sensor.test.state();
    sensor.audit = audit;
    sensor.why_not = audit.why_not;
    ++sensor.scans;
    if (audit.why_not.empty()) {
      sensor.test.add(scan_, audit.difference, audit.covariance.diagonal().cwiseSqrt());
      ++sensor.usable;
    } else {
      sensor.test.add_missing();
    }
    const DriftState now = sensor.test.state();
    if (now == before) return;
    out_ << (time_s ? fixed_number(*time_s, 1) + " s, " : "") << "scan " << scan_ << ": "
         << printable(sensor.name) << " ";
    switch (now) {
      case DriftState::right:
        out_ << (before == DriftState::drifted ? "is right again" : "is right");
        break;
      case DriftState::drifted:
        sensor.drift = sensor.test.largest_change();
        out_ << (sensor.drift.is_from_start ? "is wrong: " : "drifted: ")
             << change_text(sensor.drift) << " since "
             << (sensor.drift.is_from_start ? "the first scan"
                                            : "about scan " + std::to_string(sensor.drift.since));
        break;
      case DriftState::undecidable:
        out_ << "is undecidable: "
             << (audit.why_not.empty() ? "the scans do not constrain it"
                                       : printable(audit.why_not));
        break;
    }
    out_ << std::endl;
  }

  void print_end() {
    std::size_t columns = 0;
    for (const WatchedSensor& sensor : sensors_) {
      columns = std::max(columns, text_columns(printable(sensor.name)));
    }
    constexpr std::size_t kVerdictColumns = 13;
    for (const WatchedSensor& sensor : sensors_) {
      out_ << left_aligned(capitals(name_of(sensor.test.state())), kVerdictColumns)
           << left_aligned(printable(sensor.name), columns + 2);
      if (sensor.usable > 0) out_ << change_text(sensor.test.largest_change()) << ", ";
      out_ << sensor.usable << " of " << counted(sensor.scans, "scan") << " usable\n";
    }
    for (const std::string& line : stream_.unused())
      out_ << "not used: " << printable(line) << "\n";
  }

  const WatchOptions& options_;
  std::ostream& out_;
  std::ostream& err_;
  SceneStream stream_;
  std::vector<WatchedSensor> sensors_;
  std::optional<Auditor> auditor_;
  WatchLog log_;  ///< After the poses: a wrong request must not leave a file.
  std::size_t scan_ = 0;
  std::optional<double> first_stamp_s_;
};

}  // namespace

int watch_command(const WatchOptions& given, std::ostream& out, std::ostream& err) {
  WatchOptions options = given;
  static_cast<CalibrateOptions&>(options) = with_file(given);
  return Watch(options, out, err).run();
}

}  // namespace croon::experiments
