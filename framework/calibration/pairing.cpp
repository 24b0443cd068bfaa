#include "framework/calibration/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

using Indices = std::vector<std::optional<std::size_t>>;

template <class Sensors>
std::size_t index_of_reference(const Sensors& sensors, const std::string& reference) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].sensor == reference) return i;
  }
  throw std::logic_error("the reference is not one of the sensors");
}

/// The index of the value nearest to `value`; `values` must be ascending and not empty.
std::size_t nearest_index(const std::vector<double>& values, double value) {
  const auto after = std::lower_bound(values.begin(), values.end(), value);
  const auto index = static_cast<std::size_t>(after - values.begin());
  if (index == 0) return 0;
  if (index == values.size()) return index - 1;
  return value - values[index - 1] <= values[index] - value ? index - 1 : index;
}

/// The pairs of one sensor's clouds with those of the reference.
struct SensorPairs {
  Indices clouds;           ///< By cloud of the reference.
  std::size_t far = 0;      ///< Number of clouds without a reference cloud within the gap.
  std::size_t surplus = 0;  ///< Number of clouds whose reference cloud has a nearer one.
  double min_far_gap_s = std::numeric_limits<double>::infinity();
};

SensorPairs pairs_of(const std::vector<double>& reference_s, const std::vector<double>& stamps_s,
                     double max_time_gap_s) {
  SensorPairs pairs;
  pairs.clouds.resize(reference_s.size());
  // By cloud of the sensor: the reference cloud that it is paired with. A cloud may be the nearest
  // one to several reference clouds; the nearest of these gets it.
  Indices owners(stamps_s.size());
  for (std::size_t r = 0; r < reference_s.size() && !stamps_s.empty(); ++r) {
    const std::size_t cloud = nearest_index(stamps_s, reference_s[r]);
    const auto gap_s = [&](std::size_t to) { return std::abs(reference_s[to] - stamps_s[cloud]); };
    if (gap_s(r) > max_time_gap_s) continue;
    if (!owners[cloud] || gap_s(r) < gap_s(*owners[cloud])) owners[cloud] = r;
  }
  for (std::size_t cloud = 0; cloud < stamps_s.size(); ++cloud) {
    if (owners[cloud]) {
      pairs.clouds[*owners[cloud]] = cloud;
      continue;
    }
    const double gap_s =
        reference_s.empty()
            ? std::numeric_limits<double>::infinity()
            : std::abs(reference_s[nearest_index(reference_s, stamps_s[cloud])] - stamps_s[cloud]);
    if (gap_s <= max_time_gap_s) {
      ++pairs.surplus;
    } else {
      ++pairs.far;
      pairs.min_far_gap_s = std::min(pairs.min_far_gap_s, gap_s);
    }
  }
  return pairs;
}

std::string seconds_text(double seconds) { return shortest_number(seconds) + " s"; }

/// "left: 3 of 10 clouds are not used: ..."
std::string unused_line(const std::string& sensor, std::size_t unused, std::size_t clouds,
                        const std::string& reasons) {
  return in_quotes(sensor) + ": " + std::to_string(unused) + " of " + counted(clouds, "cloud") +
         (unused == 1 ? " is" : " are") + " not used: " + reasons;
}

std::string why_unpaired(const SensorPairs& pairs, const std::string& reference,
                         double max_time_gap_s) {
  std::string reasons;
  if (pairs.far > 0) {
    reasons = std::to_string(pairs.far) + " without a cloud of " + in_quotes(reference) +
              " within " + seconds_text(max_time_gap_s);
    if (std::isfinite(pairs.min_far_gap_s)) {
      reasons += " (the nearest is " + fixed_number(pairs.min_far_gap_s, 3) + " s away)";
    }
  }
  if (pairs.surplus > 0) {
    reasons += (reasons.empty() ? "" : ", ") + std::to_string(pairs.surplus) +
               " because another cloud is nearer";
  }
  return reasons;
}

/// Appends the scenes in which the reference and another sensor have a cloud. `pairs` has one entry
/// per sensor; the reference's is ignored. Returns the number of omitted scenes.
std::size_t add_scenes(Pairing& pairing, const std::vector<std::string>& names,
                       const std::vector<Indices>& pairs, std::size_t reference) {
  std::size_t lonely = 0;
  for (std::size_t r = 0; r < names.size(); ++r) {
    PairedScene scene{names[r], Indices(pairs.size())};
    bool has_other = false;
    for (std::size_t s = 0; s < pairs.size(); ++s) {
      if (s == reference) continue;
      scene.clouds[s] = pairs[s][r];
      has_other = has_other || scene.clouds[s].has_value();
    }
    scene.clouds[reference] = r;
    if (has_other) {
      pairing.scenes.push_back(std::move(scene));
    } else {
      ++lonely;
    }
  }
  return lonely;
}

/// The file name without its suffix, which may be ".pcd.bin".
std::string stem_of(const std::filesystem::path& file) {
  const std::filesystem::path stem = file.stem();
  return (stem.extension() == ".pcd" ? stem.stem() : stem).string();
}

std::vector<std::string> stems_of(const SensorFiles& sensor) {
  std::vector<std::string> stems;
  for (const std::filesystem::path& file : sensor.files) stems.push_back(stem_of(file));
  return stems;
}

/// The index of each of the sensor's files by its stem. Throws InputError if one occurs twice.
std::map<std::string, std::size_t> files_by_stem(const SensorFiles& sensor) {
  std::map<std::string, std::size_t> by_stem;
  for (std::size_t i = 0; i < sensor.files.size(); ++i) {
    const auto [at, is_new] = by_stem.emplace(stem_of(sensor.files[i]), i);
    if (is_new) continue;
    throw InputError(sensor.folder.string(), "",
                     "expected one file per scene, found " +
                         in_quotes(sensor.files[at->second].filename().string()) + " and " +
                         in_quotes(sensor.files[i].filename().string()));
  }
  return by_stem;
}

/// The time in the name of every file; std::nullopt if a name has none.
std::optional<std::vector<double>> stamps_in_names(const SensorFiles& sensor) {
  std::vector<double> stamps_s;
  for (const std::string& stem : stems_of(sensor)) {
    const std::optional<double> stamp_s = stamp_in_name(stem);
    if (!stamp_s) return std::nullopt;
    stamps_s.push_back(*stamp_s);
  }
  return stamps_s;
}

/// Pairs by the times in the names; std::nullopt if a file has no time in its name.
std::optional<Pairing> paired_by_times_in_names(const std::vector<SensorFiles>& sensors,
                                                const std::string& reference,
                                                double max_time_gap_s) {
  std::vector<SensorStamps> sorted;
  std::vector<std::vector<std::size_t>> orders;
  for (const SensorFiles& sensor : sensors) {
    const std::optional<std::vector<double>> stamps_s = stamps_in_names(sensor);
    if (!stamps_s) return std::nullopt;
    std::vector<std::size_t>& order = orders.emplace_back(stamps_s->size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return (*stamps_s)[a] < (*stamps_s)[b]; });
    SensorStamps& of = sorted.emplace_back(SensorStamps{sensor.sensor, {}});
    for (const std::size_t i : order) of.stamps_s.push_back((*stamps_s)[i]);
  }
  Pairing pairing = pair_by_time(sorted, reference, max_time_gap_s);
  const std::size_t r = index_of_reference(sensors, reference);
  for (PairedScene& scene : pairing.scenes) {
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      if (scene.clouds[s]) scene.clouds[s] = orders[s][*scene.clouds[s]];
    }
    scene.name = stem_of(sensors[r].files[*scene.clouds[r]]);
  }
  return pairing;
}

[[noreturn]] void fail_without_equal_names(const SensorFiles& sensor,
                                           const SensorFiles& reference) {
  throw InputError(sensor.folder.string(), "",
                   "expected files named like those of " + in_quotes(reference.sensor) +
                       " (or all by their time stamps, in s, ms, us or ns since 1970), found " +
                       in_quotes(sensor.files.front().filename().string()) + " beside " +
                       in_quotes(reference.files.front().filename().string()) +
                       "; rename the files so that those of the same moment have the same name");
}

Pairing paired_by_equal_names(const std::vector<SensorFiles>& sensors, std::size_t reference) {
  const std::vector<std::string> names = stems_of(sensors[reference]);
  files_by_stem(sensors[reference]);
  Pairing pairing;
  std::vector<Indices> pairs;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    Indices& clouds = pairs.emplace_back(names.size());
    if (s == reference) continue;
    const std::map<std::string, std::size_t> by_stem = files_by_stem(sensors[s]);
    std::size_t paired = 0;
    for (std::size_t r = 0; r < names.size(); ++r) {
      const auto at = by_stem.find(names[r]);
      if (at == by_stem.end()) continue;
      clouds[r] = at->second;
      ++paired;
    }
    if (paired == 0) fail_without_equal_names(sensors[s], sensors[reference]);
    const std::size_t unused = by_stem.size() - paired;
    if (unused == 0) continue;
    pairing.unpaired.push_back(
        unused_line(sensors[s].sensor, unused, by_stem.size(),
                    "no file of " + in_quotes(sensors[reference].sensor) + " has the same name"));
  }
  const std::size_t lonely = add_scenes(pairing, names, pairs, reference);
  if (lonely > 0) {
    pairing.unpaired.push_back(unused_line(sensors[reference].sensor, lonely, names.size(),
                                           "no file of another sensor has the same name"));
  }
  return pairing;
}

}  // namespace

Pairing pair_by_time(const std::vector<SensorStamps>& sensors, const std::string& reference,
                     double max_time_gap_s) {
  const std::size_t reference_index = index_of_reference(sensors, reference);
  const std::vector<double>& reference_s = sensors[reference_index].stamps_s;
  Pairing pairing;
  pairing.is_by_time = true;
  std::vector<Indices> pairs;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    pairs.emplace_back();
    if (s == reference_index) continue;
    SensorPairs of = pairs_of(reference_s, sensors[s].stamps_s, max_time_gap_s);
    if (const std::size_t unused = of.far + of.surplus; unused > 0) {
      pairing.unpaired.push_back(unused_line(sensors[s].sensor, unused, sensors[s].stamps_s.size(),
                                             why_unpaired(of, reference, max_time_gap_s)));
    }
    pairs.back() = std::move(of.clouds);
  }
  std::vector<std::string> names;
  for (const double stamp_s : reference_s) names.push_back(fixed_number(stamp_s, 6));
  const std::size_t lonely = add_scenes(pairing, names, pairs, reference_index);
  if (lonely > 0) {
    pairing.unpaired.push_back(
        unused_line(reference, lonely, reference_s.size(),
                    "no cloud of another sensor within " + seconds_text(max_time_gap_s)));
  }
  return pairing;
}

Pairing pair_by_name(const std::vector<SensorFiles>& sensors, const std::string& reference,
                     double max_time_gap_s) {
  const std::size_t reference_index = index_of_reference(sensors, reference);
  for (const SensorFiles& sensor : sensors) {
    if (!sensor.files.empty()) continue;
    throw InputError(sensor.folder.string(), "", "expected files with point clouds, found none");
  }
  const auto is_single = [](const SensorFiles& sensor) { return sensor.files.size() == 1; };
  if (std::all_of(sensors.begin(), sensors.end(), is_single)) {
    return {{{stem_of(sensors[reference_index].files[0]), Indices(sensors.size(), 0)}}, {}, false};
  }
  if (std::optional<Pairing> by_time =
          paired_by_times_in_names(sensors, reference, max_time_gap_s)) {
    return *std::move(by_time);
  }
  return paired_by_equal_names(sensors, reference_index);
}

std::optional<double> stamp_in_name(const std::string& stem) {
  constexpr const char* kDigits = "0123456789";
  std::size_t begin = stem.find_last_not_of("0123456789.") + 1;
  begin = std::min(stem.find_first_not_of('.', begin), stem.size());
  std::string word = stem.substr(begin);
  // Seconds and nanoseconds: "1700000000_250000000".
  constexpr std::size_t kSecondsDigits = 10, kNanosecondsDigits = 9;
  if (word.size() == kNanosecondsDigits && begin > kSecondsDigits) {
    const std::string seconds = stem.substr(begin - 1 - kSecondsDigits, kSecondsDigits);
    if (seconds.find_first_not_of(kDigits) == std::string::npos) word = seconds + "." + word;
  }
  const std::optional<double> number = number_from(word);
  if (!number) return std::nullopt;
  const bool is_whole = word.find('.') == std::string::npos;
  // From 2001 on; each unit has three digits more than the previous one.
  for (const double unit_s : {1.0, 1e-3, 1e-6, 1e-9}) {
    if (*number * unit_s < 1e9 || *number * unit_s >= 1e10) continue;
    if (unit_s < 1.0 && !is_whole) return std::nullopt;
    return *number * unit_s;
  }
  return std::nullopt;
}

}  // namespace croon
