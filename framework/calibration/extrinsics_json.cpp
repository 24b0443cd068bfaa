// The JSON formats: nuScenes and croon's own.
#include <nlohmann/json.hpp>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/calibration/extrinsics_format.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/params/json_file.hpp"
#include "framework/params/node.hpp"
#include "framework/stage/rig_files.hpp"
#include "framework/table/renderers.hpp"

namespace croon {
namespace {

/// A value of a JSON file; throws InputError at the first fault.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& value, std::string file, std::string pointer = "")
      : value_(&value), file_(std::move(file)), pointer_(std::move(pointer)) {}

  FilePlace place() const { return {file_, pointer_}; }
  const nlohmann::json& value() const { return *value_; }
  /// Whether the member exists and is not null.
  bool has(const std::string& key) const {
    return value_->is_object() && value_->contains(key) && !value_->at(key).is_null();
  }

  JsonValue member(const std::string& key) const {
    if (has(key)) return {value_->at(key), file_, pointer_ + "/" + key};
    std::vector<std::string> keys;
    if (value_->is_object()) {
      for (const auto& [other, value] : value_->items()) keys.push_back(other);
    }
    place().refuse("expected the key " + in_quotes(key) + ", found none" + name_hint(key, keys));
  }

  std::vector<JsonValue> elements() const {
    if (!value_->is_array()) place().refuse("expected a list, found " + in_quotes(shown()));
    std::vector<JsonValue> elements;
    for (const nlohmann::json& element : *value_) {
      elements.emplace_back(element, file_, pointer_ + "/" + std::to_string(elements.size()));
    }
    return elements;
  }

  std::string text() const {
    if (!value_->is_string()) place().refuse("expected a text, found " + in_quotes(shown()));
    return value_->get<std::string>();
  }

  /// A list of `N` numbers.
  template <int N>
  Eigen::Matrix<double, N, 1> vector() const {
    const std::vector<JsonValue> list = elements();
    if (list.size() != N) {
      place().refuse("expected " + std::to_string(N) + " numbers, found " + in_quotes(shown()));
    }
    Eigen::Matrix<double, N, 1> numbers;
    for (int i = 0; i < N; ++i) {
      const JsonValue& element = list[static_cast<std::size_t>(i)];
      if (!element.value().is_number()) {
        element.place().refuse("expected a number, found " + in_quotes(element.shown()));
      }
      numbers(i) = element.value().template get<double>();
    }
    return numbers;
  }

 private:
  std::string shown() const {
    return value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

  const nlohmann::json* value_;
  std::string file_, pointer_;
};

nlohmann::ordered_json number_list(const Eigen::VectorXd& numbers) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  // Adding zero turns a negative zero into a positive one.
  for (const double number : numbers) list.push_back(number + 0.0);
  return list;
}

std::vector<ExtrinsicsFile> write_nuscenes(const Extrinsics& extrinsics) {
  nlohmann::ordered_json calibrated = nlohmann::ordered_json::array();
  nlohmann::ordered_json sensors = nlohmann::ordered_json::array();
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    const Eigen::Quaterniond q = unit_quaternion(pose.T_parent_sensor.rotation);
    calibrated.push_back({{"token", pose.sensor},
                          {"sensor_token", pose.sensor},
                          {"translation", number_list(pose.T_parent_sensor.translation)},
                          {"rotation", number_list(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()))},
                          {"camera_intrinsic", nlohmann::ordered_json::array()},
                          {"parent", extrinsics.parent},
                          {"verdict", verdict_word(pose.is_accepted)}});
    sensors.push_back({{"token", pose.sensor}, {"channel", pose.sensor}, {"modality", "lidar"}});
  }
  return {{"calibrated_sensor.json", json_bytes(calibrated)}, {"sensor.json", json_bytes(sensors)}};
}

/// The channel of a sensor in the table `sensor.json` beside the file; its token if there is no
/// table.
std::string nuscenes_channel(const std::string& token, const std::filesystem::path& file) {
  const std::filesystem::path table = file.parent_path() / "sensor.json";
  std::error_code none;
  if (!std::filesystem::is_regular_file(table, none)) return token;
  const nlohmann::json json = params::read_json_file(table);
  for (const JsonValue& sensor : JsonValue(json, table.string()).elements()) {
    if (sensor.member("token").text() == token) return sensor.member("channel").text();
  }
  return token;
}

bool is_accepted_in(const JsonValue& pose) {
  if (!pose.has("verdict")) return true;
  const JsonValue verdict = pose.member("verdict");
  return is_accepted_word(verdict.text(), verdict.place());
}

std::vector<FrameLink> read_nuscenes(const ExtrinsicsSource& source) {
  const nlohmann::json json = params::parse_json(source.text, source.file());
  std::vector<FrameLink> links;
  for (const JsonValue& pose : JsonValue(json, source.file()).elements()) {
    FrameLink link;
    link.parent = pose.has("parent") ? pose.member("parent").text() : "ego";
    link.child = nuscenes_channel(pose.member("sensor_token").text(), source.path);
    link.where = pose.place().where;
    link.is_accepted = is_accepted_in(pose);
    const JsonValue rotation = pose.member("rotation");
    const JsonValue translation = pose.member("translation");
    const Eigen::Vector4d wxyz = rotation.vector<4>();
    link.T_parent_child = {
        checked_quaternion({wxyz(1), wxyz(2), wxyz(3), wxyz(0)}, rotation.place()),
        checked_position(translation.vector<3>(), translation.place())};
    links.push_back(link);
  }
  return links;
}

/// The covariance of a pose in extrinsics.json, if it has one.
std::optional<PoseCovariance> covariance_in(const JsonValue& pose) {
  if (!pose.has("covariance") || !pose.has("observability")) return std::nullopt;
  PoseCovariance covariance;
  const std::vector<JsonValue> rows = pose.member("covariance").elements();
  const JsonValue words = pose.member("observability");
  for (std::size_t i = 0; i < 6; ++i) {
    if (rows.size() != 6) pose.member("covariance").place().refuse("expected six rows");
    covariance.matrix.row(static_cast<Eigen::Index>(i)) = rows[i].vector<6>();
    const JsonValue word = words.member(kDofNames.at(i));
    const std::optional<Observability> known = observability_of(word.text());
    if (!known) {
      word.place().refuse(
          "expected an observability, found " + in_quotes(word.text()) +
          name_hint(word.text(), {kObservabilityNames.begin(), kObservabilityNames.end()}));
    }
    covariance.dofs.at(i) = *known;
  }
  if (!is_covariance(covariance.matrix)) {
    pose.member("covariance")
        .place()
        .refuse("expected a covariance: symmetric and positive semi-definite");
  }
  return covariance;
}

/// An element of "sensors" or "extrinsics"; std::nullopt if it has no pose.
std::optional<FrameLink> croon_link(const JsonValue& element, const std::string& reference) {
  FrameLink link;
  link.parent = reference;
  link.child = element.member("sensor").text();
  link.where = element.place().where;
  link.is_accepted = is_accepted_in(element);
  link.covariance = covariance_in(element);
  if (!element.has("T_reference_sensor")) return std::nullopt;
  const JsonValue pose = element.member("T_reference_sensor");
  const JsonValue rotation = pose.member("quaternion_xyzw");
  const JsonValue translation = pose.member("translation_m");
  link.T_parent_child = {checked_quaternion(rotation.vector<4>(), rotation.place()),
                         checked_position(translation.vector<3>(), translation.place())};
  return link;
}

/// Reads extrinsics.json of a calibration ("sensors") or of an experiment ("extrinsics").
std::vector<FrameLink> read_croon_extrinsics(const ExtrinsicsSource& source) {
  const nlohmann::json json = params::parse_json(source.text, source.file());
  const JsonValue root(json, source.file());
  const bool is_experiment = root.has("extrinsics");
  const std::string common = is_experiment ? "" : root.member("reference").text();
  std::string variant;
  std::vector<FrameLink> links;
  for (const JsonValue& element :
       root.member(is_experiment ? "extrinsics" : "sensors").elements()) {
    std::string reference = common;
    if (is_experiment) {
      const std::string of = element.member("variant").text();
      if (links.empty()) variant = of;
      if (of != variant) {
        element.place().refuse("expected poses of one variant, found poses of " +
                               in_quotes(variant) + " and " + in_quotes(of));
      }
      if (element.has("reference_sensor")) reference = element.member("reference_sensor").text();
    }
    if (auto link = croon_link(element, reference)) links.push_back(std::move(*link));
  }
  return links;
}

std::vector<FrameLink> read_nominal(const ExtrinsicsSource& source) {
  std::vector<FrameLink> links;
  for (const auto& [sensor, T] : read_rig_poses(source.path)) {
    links.push_back({"", sensor, T, "/" + sensor});
  }
  return links;
}

bool has_json_key(const std::string& text, const std::string& key) {
  return text.find("\"" + key + "\"") != std::string::npos;
}

}  // namespace

ExtrinsicsFormat nuscenes_format() {
  return {"nuscenes", write_nuscenes,
          [](const std::string& text) {
            return text.front() == '[' && has_json_key(text, "sensor_token");
          },
          read_nuscenes};
}

ExtrinsicsFormat croon_extrinsics_format() {
  return {"extrinsics.json", nullptr,
          [](const std::string& text) {
            return text.front() == '{' &&
                   (has_json_key(text, "sensors") || has_json_key(text, "extrinsics"));
          },
          read_croon_extrinsics};
}

ExtrinsicsFormat nominal_format() {
  // Any other object; the reader reports its faults.
  return {"nominal.json", nullptr, [](const std::string& text) { return text.front() == '{'; },
          read_nominal};
}

}  // namespace croon
