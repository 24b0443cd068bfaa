#include "framework/io/channel_names.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// Names of fields and the channels that they contain.
const std::vector<std::pair<std::string, std::string>> kOtherNames = {
    {"timestamp", kTime}, {"t", kTime},        {"time_stamp", kTime}, {"offset_time", kTime},
    {"i", kIntensity},    {"laser_id", kRing}, {"time", kTime},       {"intensity", kIntensity},
    {"ring", kRing}};

/// The name of the channel in `field`, or `field` itself. All-capital names are recognised too.
std::string known_name(const std::string& field) {
  std::string word = field;
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [other, name] : kOtherNames) {
    if (other == (other.size() > 1 ? word : field)) return name;
  }
  return field;
}

}  // namespace

std::vector<std::string> channel_names(const std::vector<std::string>& fields) {
  std::set<std::string> taken = {"x", "y", "z", "_"};
  std::vector<std::string> names;
  for (const std::string& field : fields) {
    const std::string known = known_name(field);
    const bool is_other = known == field || taken.count(known) > 0 ||
                          std::find(fields.begin(), fields.end(), known) != fields.end();
    const std::string& name = is_other ? field : known;
    names.push_back(taken.insert(name).second ? name : "");
  }
  return names;
}

std::string field_name(const std::string& name, const PointCloud& cloud) {
  if (name != kTime) return name;
  const auto is_other_time = [](const Channel& channel) {
    return channel.name != kTime && known_name(channel.name) == kTime;
  };
  const bool has_other = std::any_of(cloud.channels.begin(), cloud.channels.end(), is_other_time);
  return has_other ? name : "timestamp";
}

void check_writable(const PointCloud& cloud, const std::filesystem::path& path) {
  std::set<std::string> taken = {"x", "y", "z"};
  std::vector<std::string> fields;
  for (const Channel& channel : cloud.channels) {
    const std::string field = field_name(channel.name, cloud);
    const auto is_of_word = [](unsigned char c) { return c > 0x20 && c < 0x7f; };
    const bool is_word = !field.empty() && std::all_of(field.begin(), field.end(), is_of_word);
    if (!is_word || !taken.insert(field).second) {
      throw InputError(path.string(), "",
                       "expected channels with distinct names of one word each, found " +
                           in_quotes(channel.name));
    }
    if (channel.bytes.size() != cloud.size() * channel.bytes_per_point()) {
      throw InputError(path.string(), "",
                       "the channel " + in_quotes(channel.name) + " must be as long as the points");
    }
    fields.push_back(field);
  }
  const std::vector<std::string> read = channel_names(fields);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const std::string& name = cloud.channels[i].name;
    if (read[i] == name) continue;
    throw InputError(path.string(), "",
                     "expected another name for the channel " + in_quotes(name) +
                         (read[i].empty() ? ", which denotes padding in a file"
                                          : ", which is read as " + in_quotes(read[i])));
  }
}

}  // namespace croon
