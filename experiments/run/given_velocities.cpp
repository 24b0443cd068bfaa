#include "experiments/run/given_velocities.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/run/given_csv.hpp"
#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/stage/velocity_numbers.hpp"

namespace croon::experiments {
namespace {

/// The velocity along (0 to 2) or about (3 to 5) an axis, limited to the velocities of cars.
double velocity(const std::string& text, int index) {
  return index < 3 ? bounded_number(text, kMaxSpeed_mps, "m/s")
                   : bounded_number(text, kMaxTurnRate_degps, "deg/s");
}

/// Reads six numbers starting at field `first`: velocities along the axes, then about them in
/// degrees per second. In the result the latter come first, in radians per second.
Vector6d six_numbers(const std::vector<std::string>& fields, std::size_t first) {
  Vector6d numbers;
  for (int i = 0; i < 6; ++i) {
    const double number = velocity(fields[first + static_cast<std::size_t>(i)], i);
    numbers((i + 3) % 6) = i < 3 ? number : rad_from_deg(number);
  }
  return numbers;
}

GivenMotion motion_of(const CsvLine& line) {
  const bool has_stds = line.header != velocity_header();
  require_fields(line, has_stds ? 13 : 7);
  const Vector6d numbers = six_numbers(line.fields, 1);
  GivenMotion motion{{numbers.head<3>(), numbers.tail<3>()}, std::nullopt};
  if (!has_stds) return motion;
  motion.stds = six_numbers(line.fields, 7);
  for (std::size_t i = 7; i < line.fields.size(); ++i) {
    if (finite_number(line.fields[i]) > 0.0) continue;
    refuse("a standard deviation above 0", in_quotes(line.fields[i]));
  }
  return motion;
}

/// The faults of a file with missing scenes.
std::vector<Fault> missing(const GivenMotions& motions, const std::vector<std::string>& scenes,
                           const std::string& file) {
  std::vector<Fault> faults;
  for (const std::string& scene : scenes) {
    if (motions.count(scene) > 0) continue;
    faults.push_back(
        {file, "", "expected a velocity of scene " + in_quotes(scene) + ", found none"});
  }
  return faults;
}

/// Passes `table` to the step `named`, and adds the digest of the file to the parameters of the
/// step.
void hand_over(NamedStep& named, const GivenMotionStep& step, const VelocityTable& table) {
  auto json = nlohmann::ordered_json::parse(named.step.resolved());
  json["sha256"] = table.sha256;
  named.step = params::Slot<Step>({step.with(table.motions), named.step.name(), json.dump(),
                                   named.step.versions(), named.step.flow()});
}

std::vector<std::string> names_of(const std::vector<Scene>& scenes) {
  std::vector<std::string> names;
  for (const Scene& scene : scenes) names.push_back(scene.name);
  return names;
}

/// The files already read, by path.
using Tables = std::map<std::filesystem::path, VelocityTable>;

void resolve_step(Experiment& experiment, Variant& variant, NamedStep& named, Tables& tables,
                  const std::vector<SceneGroup>& groups, const std::filesystem::path& data_root) {
  // Keeps the step alive while its replacement is created.
  const params::Slot<Step> kept = named.step;
  const auto* const step = dynamic_cast<const GivenMotionStep*>(&*kept);
  if (step == nullptr) return;
  const Fault at = {experiment.file, location_of(experiment, variant, named), ""};
  const GivenMotionStep::File file = step->file();
  if (file.name.empty()) return;
  const std::filesystem::path path =
      found_input(experiment, file.name, data_root, at, "a file of velocities");
  if (tables.count(path) == 0) {
    std::vector<std::string> needed;
    for (const SceneGroup& group : groups) {
      for (std::string& name : names_of(group.scenes)) needed.push_back(std::move(name));
    }
    tables[path] =
        read_velocity_file(path, names_of(dataset_scenes(experiment, data_root)), needed);
    experiment.files.push_back({file.name, tables[path].sha256});
  }
  const VelocityTable& table = tables[path];
  if (!file.sha256.empty() && file.sha256 != table.sha256) {
    throw InputError(
        at.file, at.where,
        "expected the sha256 " + file.sha256 + ", found " + table.sha256 + " of " + path.string());
  }
  hand_over(named, *step, table);
}

/// `first`, followed by a column for each number of a velocity.
std::string with_columns(std::string first, std::string (VelocityNumber::*column)() const) {
  for (const VelocityNumber& number : velocity_numbers()) first += "," + (number.*column)();
  return first;
}

}  // namespace

const std::string& velocity_header() {
  static const std::string header = with_columns("scene", &VelocityNumber::column);
  return header;
}

const std::string& velocity_header_with_stds() {
  static const std::string header = with_columns(velocity_header(), &VelocityNumber::std_column);
  return header;
}

VelocityTable read_velocity_file(const std::filesystem::path& path,
                                 const std::vector<std::string>& names,
                                 const std::vector<std::string>& needed) {
  const std::set<std::string> known(names.begin(), names.end());
  VelocityTable table;
  table.sha256 = read_given_csv(
      path, {velocity_header(), velocity_header_with_stds()}, [&](const CsvLine& line) {
        const GivenMotion motion = motion_of(line);
        const std::string& scene = line.fields.front();
        if (known.count(scene) == 0) {
          const std::string hint = line.is_shown ? name_hint(scene, names) : "";
          refuse("a scene of the dataset", in_quotes(scene) + hint);
        }
        if (!table.motions.emplace(scene, motion).second) {
          refuse("each scene once", in_quotes(scene) + " again");
        }
      });
  std::vector<Fault> faults = missing(table.motions, needed, path.string());
  if (!faults.empty()) throw_first(std::move(faults), path.string());
  return table;
}

void resolve_velocities(Experiment& experiment, const std::vector<SceneGroup>& groups,
                        const std::filesystem::path& data_root) {
  Tables tables;
  std::vector<Fault> faults;
  for (Variant& variant : experiment.variants) {
    for (NamedStep& named : variant.pipeline) {
      collect_faults(faults,
                     [&] { resolve_step(experiment, variant, named, tables, groups, data_root); });
    }
  }
  if (!faults.empty()) throw InputError(without_repeats(faults));
}

}  // namespace croon::experiments
