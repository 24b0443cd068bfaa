#include "framework/io/opencalib_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iomanip>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/geometry/exact_rpy.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

constexpr const char* kDeviceKey = "device_id";
constexpr const char* kPathKey = "path";
constexpr const char* kSensorKey = "sensor";
constexpr const char* kPoseKey = "(Roll,Pitch,Yaw,tx,ty,tz)";

/// A group of lines: a device and its entry.
struct Record {
  int device_id = 0;
  std::string value;
  std::string place;    ///< Of the value.
  std::string option;   ///< The value of the optional line; empty if there is none.
  std::string comment;  ///< After the device number.
};

/// Removes a comment, `# ...`, from the end of `text` and returns its content.
std::string take_comment(std::string& text) {
  const std::size_t sign = text.find('#');
  if (sign == std::string::npos) return "";
  const std::string comment(trimmed(std::string_view(text).substr(sign + 1)));
  text = std::string(trimmed(std::string_view(text).substr(0, sign)));
  return comment;
}

/// A key in the form for comparison: without blanks, in lower case.
std::string plain_key(std::string_view text) {
  std::string key;
  for (const char c : text) {
    if (c != ' ' && c != '\t')
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return key;
}

/// Groups the lines of a file into records and collects faults.
class RecordReader {
 public:
  /// `key` is the key of the line besides `device_id`, `option` the key of an optional third line.
  RecordReader(const std::filesystem::path& path, std::string key, std::string option = "")
      : file_(path.string()), key_(std::move(key)), option_key_(std::move(option)) {}

  std::vector<Record> read() {
    const std::string text = read_whole_file(file_);
    LineReader reader(text);
    while (reader.next()) {
      std::string_view line = trimmed(reader.line());
      if (reader.number() == 1 && line.substr(0, 3) == "\xEF\xBB\xBF") line.remove_prefix(3);
      if (!line.empty()) take(line, reader.place());
    }
    close_record();
    if (records_.empty() && faults.empty()) fault("", "expected at least one device, found none");
    return records_;
  }

  void fault(const std::string& place, const std::string& message) {
    faults.push_back({file_, place, message});
  }

  std::vector<Fault> faults;

 private:
  void take(std::string_view line, const std::string& place) {
    const std::size_t colon = line.find(':');
    const std::string key = colon == std::string_view::npos ? "" : plain_key(line.substr(0, colon));
    if (!option_key_.empty() && key == option_key_) {
      return take_option(Part{std::string(trimmed(line.substr(colon + 1))), place});
    }
    const bool is_device = key == kDeviceKey;
    if (!is_device && key != plain_key(key_)) {
      return fault(place, "expected \"" + std::string(kDeviceKey) + ": NUMBER\" or \"" + key_ +
                              ": ...\", found " + in_quotes(line));
    }
    std::optional<Part>& part = is_device ? device_ : value_;
    if (part) close_record();
    part = Part{std::string(trimmed(line.substr(colon + 1))), place};
    if (device_ && value_) close_record();
  }

  struct Part {
    std::string text;
    std::string place;
  };

  /// Adds the optional line to the current record, or else to the previous one.
  void take_option(const Part& part) {
    std::string* option = device_ || value_ ? &option_ : nullptr;
    if (option == nullptr && !records_.empty()) option = &records_.back().option;
    if (option == nullptr) {
      fault(part.place, "the line precedes its device_id");
    } else if (part.text.empty()) {
      fault(part.place, "expected a name, found none");
    } else if (!option->empty()) {
      fault(part.place, "the device has a duplicate line \"" + option_key_ + "\"");
    } else {
      *option = part.text;
    }
  }

  /// Ends the current record, if any.
  void close_record() {
    if (device_ && value_) {
      const std::string comment = take_comment(device_->text);
      const std::optional<std::uint64_t> id = count_from(device_->text);
      if (id && *id <= std::numeric_limits<int>::max()) {
        add({static_cast<int>(*id), value_->text, value_->place, option_, comment});
      } else {
        fault(device_->place, "expected a device number, found " + in_quotes(device_->text));
      }
    } else if (device_) {
      fault(device_->place, "the device has no line \"" + key_ + "\"");
    } else if (value_) {
      fault(value_->place, "expected a device_id for this line, found none");
    }
    device_.reset();
    value_.reset();
    option_.clear();
  }

  void add(const Record& record) {
    const auto is_same = [&](const Record& r) { return r.device_id == record.device_id; };
    if (std::any_of(records_.begin(), records_.end(), is_same)) {
      return fault(record.place, "duplicate device " + std::to_string(record.device_id));
    }
    records_.push_back(record);
  }

  std::string file_;
  std::string key_;
  std::string option_key_;
  std::string option_;
  std::optional<Part> device_;
  std::optional<Part> value_;
  std::vector<Record> records_;
};

std::optional<RigidTransform> pose_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != 6) return std::nullopt;
  Eigen::Matrix<double, 6, 1> values;
  for (int i = 0; i < 6; ++i) {
    const std::optional<double> value = number_from(words[static_cast<std::size_t>(i)]);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    values(i) = *value;
  }
  return RigidTransform{rotation_from_rpy(values.head<3>() * rad_from_deg(1.0)), values.tail<3>()};
}

/// The text of a record's two lines.
std::string record_text(int device_id, const char* key, const std::string& value,
                        const std::string& comment = "") {
  return std::string(kDeviceKey) + ": " + std::to_string(device_id) +
         (comment.empty() ? "" : "  # " + comment) + "\n" + key + ": " + value + "\n";
}

/// The records, sorted by device. Throws InputError with all faults.
template <class Listed>
std::vector<Listed> sorted(std::vector<Listed> listed, const RecordReader& reader) {
  if (!reader.faults.empty()) throw InputError(reader.faults);
  std::sort(listed.begin(), listed.end(),
            [](const Listed& a, const Listed& b) { return a.device_id < b.device_id; });
  return listed;
}

}  // namespace

std::vector<ListedCloud> read_cloud_list(const std::filesystem::path& file) {
  RecordReader reader(file, kPathKey, kSensorKey);
  std::vector<ListedCloud> clouds;
  for (const Record& record : reader.read()) {
    if (record.value.empty()) reader.fault(record.place, "expected the path of a file, found none");
    const std::string& name = record.option;
    clouds.push_back({record.device_id, record.value, record.place,
                      name.empty() ? sensor_name_of_file(record.value) : name});
  }
  return sorted(std::move(clouds), reader);
}

std::vector<ListedPose> read_pose_list(const std::filesystem::path& file) {
  RecordReader reader(file, kPoseKey);
  std::vector<ListedPose> poses;
  for (Record record : reader.read()) {
    const std::string note = take_comment(record.value);
    const std::optional<RigidTransform> pose = pose_of(record.value);
    if (!pose) {
      reader.fault(record.place, "expected six numbers, found " + in_quotes(record.value));
    } else if (pose->translation.cwiseAbs().maxCoeff() > kMaxCoordinate_m) {
      reader.fault(record.place, "expected a position of at most " +
                                     fixed_number(kMaxCoordinate_m, 0) + " m, found " +
                                     in_quotes(record.value));
    }
    poses.push_back(
        {record.device_id, pose.value_or(RigidTransform{}), record.place, record.comment, note});
  }
  return sorted(std::move(poses), reader);
}

std::string sensor_name_of_file(const std::string& path) {
  // The authors' lists have Windows path separators.
  const std::string file = path.substr(path.find_last_of("/\\") + 1);
  const std::string stem = std::filesystem::path(file).stem().string();
  return stem.substr(0, stem.find('-'));
}

std::string cloud_list_text(const std::vector<ListedCloud>& clouds) {
  std::string text;
  for (const ListedCloud& cloud : clouds) {
    text += record_text(cloud.device_id, kPathKey, cloud.path);
    if (!cloud.sensor.empty() && cloud.sensor != sensor_name_of_file(cloud.path)) {
      text += std::string(kSensorKey) + ": " + cloud.sensor + "\n";
    }
  }
  return text;
}

std::string pose_list_text(const std::vector<ListedPose>& poses) {
  std::string text;
  for (const ListedPose& pose : poses) {
    const RigidTransform& T = pose.T_reference_sensor;
    const Eigen::Vector3d rpy_deg = exact_rpy(T.rotation) / rad_from_deg(1.0);
    std::ostringstream value;
    value.imbue(std::locale::classic());
    value << std::setprecision(std::numeric_limits<double>::max_digits10);
    for (int i = 0; i < 3; ++i) value << rpy_deg(i) << ' ';
    for (int i = 0; i < 3; ++i) value << T.translation(i) << (i < 2 ? " " : "");
    if (!pose.note.empty()) value << "  # " << pose.note;
    text += record_text(pose.device_id, kPoseKey, value.str(), pose.sensor);
  }
  return text;
}

}  // namespace croon
