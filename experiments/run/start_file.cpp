#include "experiments/run/start_file.hpp"

#include <algorithm>
#include <string_view>

#include "experiments/run/start_line.hpp"
#include "framework/base/error.hpp"
#include "framework/base/nearest_name.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/text_scan.hpp"

namespace croon::experiments {
namespace {

constexpr std::size_t kShownFaults = 10;

/// Gathers the lines of a file, in any order.
class StartLines {
 public:
  explicit StartLines(const std::vector<Scene>& scenes) {
    for (const Scene& scene : scenes) {
      scenes_.push_back(scene.name);
      for (const SensorScan& scan : scene.sensors) starts_[{scene.name, scan.sensor}];
    }
  }

  void add(const StartLine& line) {
    const auto found = starts_.find({line.scene, line.sensor});
    if (found == starts_.end()) refuse_place(line);
    if (!found->second.emplace(line.trial, line.start).second) {
      refuse("each trial once", "trial " + std::to_string(line.trial) + " of sensor " +
                                    in_quotes(line.sensor) + " in scene " + in_quotes(line.scene) +
                                    " again");
    }
    trials_ = std::max(trials_, line.trial + 1);
  }

  /// The starts, of each sensor as many; notes a fault for each sensor that lacks one.
  StartTable table(const std::string& file, std::vector<Fault>& faults) const {
    StartTable table;
    table.trials = trials_;
    for (const auto& [place, by_trial] : starts_) {
      std::vector<Start>& starts = table.starts[place];
      for (const auto& [trial, start] : by_trial) {
        if (trial != static_cast<int>(starts.size())) break;
        starts.push_back(start);
      }
      if (static_cast<int>(starts.size()) == trials_) continue;
      faults.push_back({file, "",
                        "expected trials 0 to " + std::to_string(trials_ - 1) + " of sensor " +
                            in_quotes(place.second) + " in scene " + in_quotes(place.first) +
                            ", found no trial " + std::to_string(starts.size())});
    }
    return table;
  }

 private:
  [[noreturn]] void refuse_place(const StartLine& line) const {
    std::vector<std::string> sensors;
    for (const auto& [place, starts] : starts_) {
      if (place.first == line.scene) sensors.push_back(place.second);
    }
    if (sensors.empty()) {
      refuse("a scene of the dataset", in_quotes(line.scene) + name_hint(line.scene, scenes_));
    }
    refuse("a sensor of scene " + in_quotes(line.scene),
           in_quotes(line.sensor) + name_hint(line.sensor, sensors));
  }

  std::vector<std::string> scenes_;
  std::map<std::pair<std::string, std::string>, std::map<int, Start>> starts_;
  int trials_ = 0;
};

/// Spreadsheets put one before the first line.
std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  return bytes.substr(0, kMark.size()) == kMark ? bytes.substr(kMark.size()) : bytes;
}

/// The first faults, and how many more there are.
[[noreturn]] void throw_first(std::vector<Fault> faults, const std::string& file) {
  if (faults.size() > kShownFaults) {
    const std::size_t more = faults.size() - kShownFaults;
    faults.resize(kShownFaults);
    faults.push_back({file, "", "and " + std::to_string(more) + " more faults"});
  }
  throw InputError(std::move(faults));
}

}  // namespace

StartTable read_start_file(const std::filesystem::path& path, const std::vector<Scene>& scenes) {
  const std::string bytes = read_whole_file(path);
  const std::string file = path.string();
  LineReader reader(without_byte_order_mark(bytes));
  if (!reader.next() || reader.line() != kStartHeader) {
    throw InputError(file, "line 1",
                     "expected " + in_quotes(kStartHeader) + ", found " + in_quotes(reader.line()));
  }
  StartLines lines(scenes);
  std::vector<Fault> faults;
  while (reader.next()) {
    try {
      lines.add(read_start_line(std::string(reader.line())));
    } catch (const InputError& error) {
      faults.push_back({file, reader.place(), error.faults().front().message});
    }
  }
  if (!faults.empty()) throw_first(std::move(faults), file);
  StartTable table = lines.table(file, faults);
  if (table.trials == 0) throw InputError(file, "line 2", "expected a start, found the end");
  if (!faults.empty()) throw_first(std::move(faults), file);
  table.sha256 = sha256_of_text(bytes);
  return table;
}

}  // namespace croon::experiments
