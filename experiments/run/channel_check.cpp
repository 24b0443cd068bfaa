#include "experiments/run/channel_check.hpp"

#include <algorithm>
#include <map>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

/// The channels needed from a cloud, each with the first step and variant that needs it.
using Needs = std::map<std::string, std::string>;

struct NeedsOfClouds {
  Needs target, source;
};

NeedsOfClouds needs_of(const Experiment& experiment, const Selection& selection) {
  NeedsOfClouds needs;
  for (const std::size_t index : selection.variants) {
    const Variant& variant = experiment.variants[index];
    for (const NamedStep& step : variant.pipeline) {
      const std::string who = "the step \"" + step.name + "\" of variant \"" + variant.name + "\"";
      for (const std::string& channel : step.step.flow().target_channels) {
        needs.target.emplace(channel, who);
      }
      for (const std::string& channel : step.step.flow().source_channels) {
        needs.source.emplace(channel, who);
      }
    }
  }
  return needs;
}

/// Collects missing channels: the first cloud for each sensor and channel, and the number of
/// clouds.
class Lacking {
 public:
  explicit Lacking(std::string file) : file_(std::move(file)) {}

  /// Notes which of `needs` the cloud of `scan` lacks.
  void look_at(const SensorScan& scan, const Needs& needs) {
    if (!scan.channels) return;
    const std::vector<std::string>& found = *scan.channels;
    for (const auto& [channel, who] : needs) {
      if (std::find(found.begin(), found.end(), channel) != found.end()) continue;
      Entry& entry = entries_[{scan.sensor, channel}];
      if (entry.clouds++ > 0) continue;
      entry.fault = {scan.file.empty() ? file_ : scan.file, "",
                     "expected the channel \"" + channel + "\" in the cloud of sensor \"" +
                         scan.sensor + "\", which " + who + " needs; found " +
                         (found.empty() ? "no channel" : list_text(found))};
    }
  }

  std::vector<Fault> faults() const {
    std::vector<Fault> faults;
    for (const auto& [key, entry] : entries_) {
      faults.push_back(entry.fault);
      if (entry.clouds > 1) {
        faults.back().message += " (and the same in " + std::to_string(entry.clouds - 1) +
                                 (entry.clouds == 2 ? " more scene)" : " more scenes)");
      }
    }
    return faults;
  }

 private:
  struct Entry {
    Fault fault;
    std::size_t clouds = 0;
  };
  std::string file_;  ///< The experiment file.
  std::map<std::pair<std::string, std::string>, Entry> entries_;
};

/// Notes the channels missing in the clouds of `group`. With pairs of sensors, the clouds of all
/// but the last sensor of a scene are also targets.
void look_at(const SceneGroup& group, bool loops, const NeedsOfClouds& needs, Lacking& lacking) {
  Needs both = needs.source;
  both.insert(needs.target.begin(), needs.target.end());
  for (const Scene& scene : group.scenes) {
    lacking.look_at(scene.reference, needs.target);
    for (const SensorScan& scan : scene.sensors) {
      lacking.look_at(scan, loops && &scan != &scene.sensors.back() ? both : needs.source);
    }
  }
}

}  // namespace

std::set<std::string> needed_channels(const Experiment& experiment) {
  std::set<std::string> names;
  for (const Variant& variant : experiment.variants) {
    for (const NamedStep& step : variant.pipeline) {
      const std::set<std::string> channels = step.step.flow().channels();
      names.insert(channels.begin(), channels.end());
    }
  }
  return names;
}

void check_channels(const Experiment& experiment, const std::vector<SceneGroup>& groups,
                    const Selection& selection) {
  const NeedsOfClouds needs = needs_of(experiment, selection);
  Lacking lacking(experiment.file);
  for (const SceneGroup& group : groups) look_at(group, experiment.loops, needs, lacking);
  std::vector<Fault> faults = lacking.faults();
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace croon::experiments
