// The plain-text formats: rows of numbers.
#include <algorithm>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/extrinsics_format.hpp"
#include "framework/io/opencalib_files.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

constexpr std::string_view kTransformKey = "Tr_";
constexpr std::string_view kBetweenFrames = "_to_";

/// A name that is valid in a KITTI key: one word without a colon and without "_to_".
std::string kitti_name(const std::string& name) {
  std::string word = ros_frame_name(name);
  std::replace_if(
      word.begin(), word.end(), [](char c) { return c == ' ' || c == ':'; }, '_');
  for (std::size_t at = word.find(kBetweenFrames); at != std::string::npos;
       at = word.find(kBetweenFrames)) {
    word.replace(at, kBetweenFrames.size(), "-to-");
  }
  return word;
}

std::vector<ExtrinsicsFile> write_kitti(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, kitti_name);
  std::string text;
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    const std::string names = pose.sensor + std::string(kBetweenFrames) + extrinsics.parent + ": ";
    // KITTI readers split each line at its first colon and skip everything that is not a number.
    if (!pose.is_accepted || pose.is_doubtful) {
      text += "# " + names + verdict_comment(pose) + "\n";
    }
    text += std::string(kTransformKey) + names +
            decimal_numbers(rows_of(pose.T_parent_sensor, 3), " ") + "\n";
  }
  return {{"calib.txt", text}};
}

bool is_transform_line(std::string_view line) {
  return line.substr(0, kTransformKey.size()) == kTransformKey &&
         line.find(':') != std::string_view::npos;
}

std::vector<FrameLink> read_kitti(const ExtrinsicsSource& source) {
  std::vector<FrameLink> links;
  LineReader lines(source.text);
  while (lines.next()) {
    const std::string_view line = trimmed(lines.line());
    if (!is_transform_line(line)) continue;
    const FilePlace place = {source.file(), lines.place()};
    const std::size_t colon = line.find(':');
    const std::string_view names = line.substr(kTransformKey.size(), colon - kTransformKey.size());
    // The tracking benchmark has no "to": Tr_imu_velo.
    std::size_t between = names.find(kBetweenFrames);
    std::size_t size = kBetweenFrames.size();
    if (between == std::string_view::npos && std::count(names.begin(), names.end(), '_') == 1) {
      between = names.find('_');
      size = 1;
    }
    if (between == std::string_view::npos) {
      place.refuse("expected a key Tr_SENSOR_to_PARENT, found " + in_quotes(line.substr(0, colon)));
    }
    links.push_back(
        {std::string(names.substr(between + size)), std::string(names.substr(0, between)),
         checked_pose(numbers_in(line.substr(colon + 1), 12, place), place), place.where});
  }
  return links;
}

bool is_kitti(const std::string& text) {
  LineReader lines(text);
  while (lines.next()) {
    if (is_transform_line(trimmed(lines.line()))) return true;
  }
  return false;
}

std::vector<ExtrinsicsFile> write_matrix(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, printable_name);
  const Extrinsics stems = renamed(original, file_stem);
  std::vector<ExtrinsicsFile> files;
  for (std::size_t i = 0; i < extrinsics.poses.size(); ++i) {
    const ExtrinsicPose& pose = extrinsics.poses[i];
    std::string text =
        "# Maps points of the sensor to the parent. Metres.\n# sensor: " + pose.sensor +
        "\n# parent: " + extrinsics.parent + "\n# verdict: " + verdict_word(pose.is_accepted) +
        "\n";
    const std::vector<double> numbers = rows_of(pose.T_parent_sensor, 4);
    for (auto row = numbers.begin(); row != numbers.end(); row += 4) {
      text += decimal_numbers({row, row + 4}, " ") + "\n";
    }
    files.push_back({stems.poses[i].sensor + ".txt", text});
  }
  return files;
}

/// The value of a comment `# key: value`; std::nullopt for any other line.
std::optional<std::string> comment_value(std::string_view line, const std::string& key) {
  const std::string begin = "# " + key + ":";
  if (line.substr(0, begin.size()) != begin) return std::nullopt;
  return std::string(trimmed(line.substr(begin.size())));
}

std::vector<FrameLink> read_matrix(const ExtrinsicsSource& source) {
  FrameLink link;
  link.child = source.path.stem().string();
  std::vector<double> numbers;
  LineReader lines(source.text);
  while (lines.next()) {
    const std::string_view line = trimmed(lines.line());
    const FilePlace place = {source.file(), lines.place()};
    if (const auto sensor = comment_value(line, "sensor")) link.child = *sensor;
    if (const auto parent = comment_value(line, "parent")) link.parent = *parent;
    if (const auto verdict = comment_value(line, "verdict")) {
      link.is_accepted = is_accepted_word(*verdict, place);
    }
    const std::string_view row = trimmed(line.substr(0, line.find('#')));
    if (row.empty()) continue;
    const std::vector<double> values = numbers_in(row, 4, place);
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  link.T_parent_child = checked_pose(numbers, {source.file(), ""});
  return {link};
}

/// Whether all lines but comments are numbers.
bool is_matrix(const std::string& text) {
  LineReader lines(text);
  int rows = 0;
  while (lines.next()) {
    std::string row(trimmed(lines.line().substr(0, lines.line().find('#'))));
    std::replace(row.begin(), row.end(), ',', ' ');
    const std::vector<std::string_view> words = words_of(row);
    const auto is_number = [](std::string_view word) { return number_from(word).has_value(); };
    if (!std::all_of(words.begin(), words.end(), is_number)) return false;
    if (!words.empty()) ++rows;
  }
  return rows > 0;
}

constexpr const char* kCsvHeader = "sensor,verdict,tx_m,ty_m,tz_m,qx,qy,qz,qw";
constexpr std::size_t kCsvColumns = 9;

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

std::vector<ExtrinsicsFile> write_csv(const Extrinsics& extrinsics) {
  std::string text = std::string(kCsvHeader) + "\n";
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    text += csv_field(pose.sensor) + "," + verdict_word(pose.is_accepted);
    const RigidTransform& T = pose.T_parent_sensor;
    const auto field = [&](double value) { return pose.has_pose ? shortest_number(value) : ""; };
    for (const double value : T.translation) text += "," + field(value);
    const Eigen::Quaterniond xyzw = unit_quaternion(T.rotation);
    for (const double value : xyzw.coeffs()) text += "," + field(value);
    text += "\n";
  }
  return {{"extrinsics.csv", text}};
}

/// A row of a CSV file.
struct CsvRow {
  std::vector<std::string> fields = {""};
  int line = 1;
  bool is_empty() const { return fields.size() == 1 && fields.front().empty(); }
};

/// Parses CSV as in RFC 4180.
std::vector<CsvRow> csv_rows(const std::string& text) {
  std::vector<CsvRow> rows(1);
  bool is_quoted = false;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& field = rows.back().fields.back();
    if (c == '\n') ++line;
    if (c == '"' && is_quoted && i + 1 < text.size() && text[i + 1] == '"') {
      field += text[++i];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      rows.back().fields.emplace_back();
    } else if (c == '\n' && !is_quoted) {
      rows.emplace_back().line = line;
    } else if (c != '\r' || is_quoted) {
      field += c;
    }
  }
  rows.erase(std::remove_if(rows.begin(), rows.end(), [](const CsvRow& r) { return r.is_empty(); }),
             rows.end());
  return rows;
}

FrameLink link_of_row(const CsvRow& row, const FilePlace& place) {
  FrameLink link;
  link.child = row.fields[0];
  link.is_accepted = is_accepted_word(row.fields[1], place);
  link.where = place.where;
  std::vector<double> numbers;
  for (std::size_t i = 2; i < kCsvColumns; ++i) {
    numbers.push_back(numbers_in(row.fields[i], 1, place).front());
  }
  link.T_parent_child = {checked_quaternion(Eigen::Vector4d(numbers.data() + 3), place),
                         checked_position(Eigen::Vector3d(numbers.data()), place)};
  return link;
}

std::vector<FrameLink> read_csv(const ExtrinsicsSource& source) {
  std::vector<CsvRow> rows = csv_rows(source.text);
  std::string header(source.text.substr(0, source.text.find('\n')));
  header.erase(std::remove(header.begin(), header.end(), '\r'), header.end());
  if (header != kCsvHeader) {
    throw InputError(
        source.file(), "line 1",
        std::string("expected the header ") + kCsvHeader + ", found " + in_quotes(header));
  }
  std::vector<FrameLink> links;
  for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
    const FilePlace place = {source.file(), "line " + std::to_string(row->line)};
    if (row->fields.size() != kCsvColumns) {
      place.refuse("expected " + std::to_string(kCsvColumns) + " columns, found " +
                   std::to_string(row->fields.size()));
    }
    const auto is_empty = [](const std::string& field) { return field.empty(); };
    const bool has_pose = !std::all_of(row->fields.begin() + 2, row->fields.end(), is_empty);
    if (has_pose || row->fields[1] != verdict_word(false)) {
      links.push_back(link_of_row(*row, place));
    }
  }
  return links;
}

std::vector<ExtrinsicsFile> write_opencalib(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, printable_name);
  std::vector<ListedPose> poses = {{0, {}, "", extrinsics.parent}};
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    const RigidTransform& T = pose.T_parent_sensor;
    poses.push_back({static_cast<int>(poses.size()), T, "", pose.sensor});
    if (!pose.is_accepted) poses.back().note = verdict_comment(pose);
  }
  return {{"initial_extrinsic.txt", pose_list_text(poses)}};
}

/// The name of a device from the list of clouds beside the file; empty if there is none.
std::string listed_sensor(const std::filesystem::path& file, int device_id) {
  const std::filesystem::path list = file.parent_path() / "lidar_cloud_path.txt";
  std::error_code none;
  if (!std::filesystem::is_regular_file(list, none)) return "";
  for (const ListedCloud& cloud : read_cloud_list(list)) {
    if (cloud.device_id == device_id) return cloud.sensor;
  }
  return "";
}

std::vector<FrameLink> read_opencalib(const ExtrinsicsSource& source) {
  std::string parent;
  std::vector<FrameLink> links;
  for (ListedPose& pose : read_pose_list(source.path)) {
    if (pose.sensor.empty()) pose.sensor = listed_sensor(source.path, pose.device_id);
    if (pose.sensor.empty()) pose.sensor = std::to_string(pose.device_id);
    const RigidTransform& T = pose.T_reference_sensor;
    // Device 0 is the reference, whose own pose is in the file too.
    if (pose.device_id == 0 && T.translation.isZero(0.0) && T.rotation.isIdentity(0.0)) {
      parent = pose.sensor;
    } else {
      links.push_back({parent, pose.sensor, T, pose.place, pose.note.empty()});
    }
  }
  return links;
}

}  // namespace

ExtrinsicsFormat kitti_format() { return {"kitti", write_kitti, is_kitti, read_kitti}; }

ExtrinsicsFormat matrix_format() { return {"matrix", write_matrix, is_matrix, read_matrix}; }

ExtrinsicsFormat csv_format() {
  return {"csv", write_csv, [](const std::string& text) { return text.substr(0, 7) == "sensor,"; },
          read_csv, true};
}

ExtrinsicsFormat opencalib_format() {
  return {"opencalib", write_opencalib,
          [](const std::string& text) { return text.find("device_id") != std::string::npos; },
          read_opencalib};
}

}  // namespace croon
