#pragma once

#include <set>
#include <string>
#include <vector>

namespace croon::params {

/// A value that one step adds to the estimate and a later one reads; see `Extra`.
struct ExtraDoc {
  std::string name;     ///< "hypotheses".
  std::string type;     ///< Name of its C++ type; equal for equal types.
  std::string meaning;  ///< Description for help: "poses that are still possible".
};

/// The needs of a stage besides points and poses, and what it provides. Declared by the stage,
/// shown in help, checked before anything runs.
struct DataFlow {
  std::set<std::string> target_channels;  ///< Required in the reference's cloud.
  std::set<std::string> source_channels;  ///< Required in the sensor's cloud.
  std::vector<ExtraDoc> takes;            ///< Extras that it requires.
  std::vector<ExtraDoc> gives;            ///< Extras that it provides.
  /// The sensors whose names are in the stage's parameters; help does not show them.
  std::set<std::string> named_sensors = {};
  /// Channels that it reads from the clouds that have them.
  std::set<std::string> optional_channels = {};

  /// All channels that it reads.
  std::set<std::string> channels() const {
    std::set<std::string> all = target_channels;
    all.insert(source_channels.begin(), source_channels.end());
    all.insert(optional_channels.begin(), optional_channels.end());
    return all;
  }

  /// Adds the channels that `other` reads.
  void add_channels(const DataFlow& other) {
    target_channels.insert(other.target_channels.begin(), other.target_channels.end());
    source_channels.insert(other.source_channels.begin(), other.source_channels.end());
    optional_channels.insert(other.optional_channels.begin(), other.optional_channels.end());
  }

  /// Adds everything that `other` needs and provides.
  void add(const DataFlow& other) {
    add_channels(other);
    takes.insert(takes.end(), other.takes.begin(), other.takes.end());
    gives.insert(gives.end(), other.gives.begin(), other.gives.end());
    named_sensors.insert(other.named_sensors.begin(), other.named_sensors.end());
  }
};

/// The flow of a stage that needs the channels `names` in every input cloud.
inline DataFlow needs_channels(const std::set<std::string>& names) {
  return {names, names, {}, {}};
}

/// The flow of a stage that reads the channels `names` of every input cloud that has them.
inline DataFlow may_read_channels(const std::set<std::string>& names) {
  DataFlow flow;
  flow.optional_channels = names;
  return flow;
}

}  // namespace croon::params
