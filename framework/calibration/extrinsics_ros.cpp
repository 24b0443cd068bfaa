// The ROS formats other than YAML: launch files and robot descriptions.
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/extrinsics_format.hpp"
#include "framework/geometry/exact_rpy.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

constexpr const char* kPublisher = "static_transform_publisher";
constexpr std::array<const char*, 12> kPublisherOptions = {
    "--x",  "--y",    "--z",     "--qx",  "--qy",       "--qz",
    "--qw", "--roll", "--pitch", "--yaw", "--frame-id", "--child-frame-id"};

/// The lines of one node in the launch file.
std::string launch_node(const std::string& parent, const ExtrinsicPose& pose) {
  const RigidTransform& T = pose.T_parent_sensor;
  const Eigen::Vector4d q = unit_quaternion(T.rotation).coeffs();
  const std::array<double, 7> values = {
      T.translation.x(), T.translation.y(), T.translation.z(), q(0), q(1), q(2), q(3)};
  std::string text =
      "        # " + verdict_comment(pose) +
      "\n        Node(\n            package=\"tf2_ros\",\n            executable=\"" + kPublisher +
      "\",\n            arguments=[\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += std::string("                \"") + kPublisherOptions[i] + "\", \"" +
            decimal_number(values[i]) + "\",\n";
  }
  text += "                \"--frame-id\", " + in_escaped_quotes(parent) +
          ",\n                \"--child-frame-id\", " + in_escaped_quotes(pose.sensor) +
          ",\n            ],\n        ),\n";
  return text;
}

std::vector<ExtrinsicsFile> write_ros2(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, ros_frame_name);
  std::string text =
      "# Static transforms of calibrated sensors; each maps the child frame to the parent frame.\n"
      "# ros2 launch ./extrinsics.launch.py\n"
      "from launch import LaunchDescription\n"
      "from launch_ros.actions import Node\n\n\n"
      "def generate_launch_description():\n"
      "    return LaunchDescription([\n";
  for (const ExtrinsicPose& pose : extrinsics.poses) text += launch_node(extrinsics.parent, pose);
  return {{"extrinsics.launch.py", text + "    ])\n"}};
}

/// A word of a launch file or of a shell script.
struct LaunchWord {
  std::string text;
  int line = 0;
};

/// Splits Python, YAML or XML launch files and shell scripts into words, without quotes, brackets
/// and comments.
class LaunchWords {
 public:
  static std::vector<LaunchWord> of(const std::string& text) {
    LaunchWords words;
    words.split(text, 1);
    return words.words_;
  }

 private:
  static constexpr const char* kBetween = " \t\r\n,[](){}=<>\\;";

  void split(const std::string& text, int line) {
    for (std::size_t at = 0; at < text.size();) {
      const char c = text[at];
      if (c == '\n') ++line;
      if (c == '"' || c == '\'') {
        at = quoted_word(text, at, line);
      } else if (c == '#') {
        at = std::min(text.find('\n', at), text.size());
      } else if (std::string(kBetween).find(c) != std::string::npos) {
        ++at;
      } else {
        const std::size_t end =
            std::min(text.find_first_of(std::string(kBetween) + "\"'", at), text.size());
        words_.push_back({text.substr(at, end - at), line});
        at = end;
      }
    }
  }

  /// Returns the position after the closing quote.
  std::size_t quoted_word(const std::string& text, std::size_t at, int line) {
    const char quote = text[at++];
    std::string word;
    for (; at < text.size() && text[at] != quote; ++at) {
      if (text[at] == '\\' && at + 1 < text.size()) ++at;
      word += text[at];
    }
    // In XML and YAML, one string has all arguments.
    if (word.find("--") != std::string::npos && word.find(' ') != std::string::npos) {
      split(word, line);
    } else {
      words_.push_back({word, line});
    }
    return at + 1;
  }

  std::vector<LaunchWord> words_;
};

/// The arguments of one publisher.
class PublisherArguments {
 public:
  PublisherArguments(std::vector<LaunchWord> words, std::string file)
      : words_(std::move(words)), file_(std::move(file)) {
    for (std::size_t i = 1; i < words_.size(); ++i) {
      const std::string& name = words_[i].text;
      if (name.substr(0, 2) != "--" || name == "--ros-args") continue;
      if (i + 1 == words_.size()) place(words_[i]).refuse("expected a value after " + name);
      options_[name] = &words_[i + 1];
    }
  }

  /// std::nullopt if there are no arguments, i.e. if the text merely mentions the program.
  std::optional<FrameLink> link() const {
    if (options_.empty()) return positional_link();
    FrameLink link;
    link.parent = frame("--frame-id");
    link.child = frame("--child-frame-id");
    link.where = place(words_.front()).where;
    link.T_parent_child.translation =
        checked_position({number("--x"), number("--y"), number("--z")}, place(words_.front()));
    link.T_parent_child.rotation = rotation();
    return link;
  }

 private:
  FilePlace place(const LaunchWord& word) const {
    return {file_, "line " + std::to_string(word.line)};
  }

  const LaunchWord* option(const std::string& name) const {
    const auto found = options_.find(name);
    return found == options_.end() ? nullptr : found->second;
  }

  double number(const std::string& name, double without = 0.0) const {
    const LaunchWord* word = option(name);
    return word == nullptr ? without : numbers_in(word->text, 1, place(*word)).front();
  }

  std::string frame(const std::string& name) const {
    if (const LaunchWord* word = option(name)) return word->text;
    std::vector<std::string> names;
    for (const auto& [given, word] : options_) names.push_back(given);
    place(words_.front()).refuse("expected " + name + ", found none" + name_hint(name, names));
  }

  Eigen::Matrix3d rotation() const {
    const auto has = [&](const char* name) { return option(name) != nullptr; };
    const FilePlace at = place(words_.front());
    if (has("--roll") || has("--pitch") || has("--yaw")) {
      return checked_radians({number("--roll"), number("--pitch"), number("--yaw")}, at);
    }
    return checked_quaternion({number("--qx"), number("--qy"), number("--qz"), number("--qw", 1.0)},
                              at);
  }

  /// The older form: x y z yaw pitch roll (or qx qy qz qw), parent, child.
  std::optional<FrameLink> positional_link() const {
    std::vector<double> numbers;
    std::size_t next = 1;
    for (; next < words_.size() && numbers.size() < 7; ++next) {
      const std::optional<double> number = number_from(words_[next].text);
      if (!number && !numbers.empty()) break;
      if (number) numbers.push_back(*number);
    }
    if (numbers.size() < 6 || next + 1 >= words_.size()) return std::nullopt;
    FrameLink link;
    const FilePlace at = place(words_.front());
    link.parent = words_[next].text;
    link.child = words_[next + 1].text;
    link.where = at.where;
    link.T_parent_child.translation = checked_position({numbers[0], numbers[1], numbers[2]}, at);
    link.T_parent_child.rotation =
        numbers.size() == 7
            ? checked_quaternion({numbers[3], numbers[4], numbers[5], numbers[6]}, at)
            : checked_radians({numbers[5], numbers[4], numbers[3]}, at);
    return link;
  }

  std::vector<LaunchWord> words_;
  std::string file_;
  std::map<std::string, const LaunchWord*> options_;
};

std::vector<FrameLink> read_ros2(const ExtrinsicsSource& source) {
  const std::vector<LaunchWord> words = LaunchWords::of(source.text);
  const auto is_publisher = [](const LaunchWord& word) { return word.text == kPublisher; };
  std::vector<FrameLink> links;
  for (auto at = std::find_if(words.begin(), words.end(), is_publisher); at != words.end();) {
    const auto next = std::find_if(at + 1, words.end(), is_publisher);
    const PublisherArguments arguments({at, next}, source.file());
    if (std::optional<FrameLink> link = arguments.link()) links.push_back(std::move(*link));
    at = next;
  }
  return links;
}

std::string xml_escaped(const std::string& text) {
  static const std::map<char, std::string> escapes = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string escaped;
  for (const char c : text) {
    const auto escape = escapes.find(c);
    escaped += escape == escapes.end() ? std::string(1, c) : escape->second;
  }
  return escaped;
}

std::vector<ExtrinsicsFile> write_urdf(const Extrinsics& original) {
  const Extrinsics extrinsics = renamed(original, ros_frame_name);
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<!-- Calibrated sensors. xyz in metres, rpy in radians, R = Rz(yaw) Ry(pitch) Rx(roll). "
      "-->\n"
      "<robot name=\"sensors\">\n  <link name=\"" +
      xml_escaped(extrinsics.parent) + "\"/>\n";
  for (const ExtrinsicPose& pose : extrinsics.poses) {
    const Eigen::Vector3d t = pose.T_parent_sensor.translation;
    const Eigen::Vector3d rpy = exact_rpy(pose.T_parent_sensor.rotation);
    const std::string name = xml_escaped(pose.sensor);
    text += "  <!-- " + verdict_comment(pose) + " -->\n  <link name=\"" + name +
            "\"/>\n  <joint name=\"" + name + "_joint\" type=\"fixed\">\n    <parent link=\"" +
            xml_escaped(extrinsics.parent) + "\"/>\n    <child link=\"" + name +
            "\"/>\n    <origin xyz=\"" + decimal_numbers({t.x(), t.y(), t.z()}, " ") + "\" rpy=\"" +
            decimal_numbers({rpy.x(), rpy.y(), rpy.z()}, " ") + "\"/>\n  </joint>\n";
  }
  return {{"extrinsics.urdf", text + "</robot>\n"}};
}

using tinyxml2::XMLElement;

FilePlace place_of_element(const XMLElement& element, const std::string& file) {
  return {file, "line " + std::to_string(element.GetLineNum())};
}

/// The attribute `link` of the child element `name`.
std::string linked_frame(const XMLElement& joint, const char* name, const std::string& file) {
  const XMLElement* element = joint.FirstChildElement(name);
  const char* link = element == nullptr ? nullptr : element->Attribute("link");
  if (link == nullptr) {
    place_of_element(joint, file)
        .refuse(std::string("expected <") + name + " link=\"...\"/> in the joint, found none");
  }
  return link;
}

/// The three numbers of an attribute; zeros if it is missing, as URDF defines.
Eigen::Vector3d three_numbers(const XMLElement& element, const char* name,
                              const std::string& file) {
  const char* text = element.Attribute(name);
  if (text == nullptr) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d(numbers_in(text, 3, place_of_element(element, file)).data());
}

FrameLink link_of_joint(const XMLElement& joint, const std::string& file) {
  FrameLink link;
  link.parent = linked_frame(joint, "parent", file);
  link.child = linked_frame(joint, "child", file);
  link.where = place_of_element(joint, file).where;
  const char* type = joint.Attribute("type");
  link.is_fixed = type != nullptr && std::string(type) == "fixed";
  if (const XMLElement* origin = joint.FirstChildElement("origin")) {
    const FilePlace place = place_of_element(*origin, file);
    link.T_parent_child = {checked_radians(three_numbers(*origin, "rpy", file), place),
                           checked_position(three_numbers(*origin, "xyz", file), place)};
  }
  return link;
}

std::vector<FrameLink> read_urdf(const ExtrinsicsSource& source) {
  tinyxml2::XMLDocument document;
  if (document.Parse(source.text.data(), source.text.size()) != tinyxml2::XML_SUCCESS) {
    const int line = document.ErrorLineNum();
    throw InputError(source.file(), line > 0 ? "line " + std::to_string(line) : "",
                     std::string("expected XML, found: ") + document.ErrorName());
  }
  const XMLElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr) throw InputError(source.file(), "", "expected <robot>, found none");
  std::vector<FrameLink> links;
  for (const XMLElement* joint = robot->FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    links.push_back(link_of_joint(*joint, source.file()));
  }
  return links;
}

}  // namespace

ExtrinsicsFormat ros2_format() {
  return {"ros2", write_ros2,
          [](const std::string& text) {
            return text.find(kPublisher) != std::string::npos &&
                   text.find("<robot") == std::string::npos;
          },
          read_ros2};
}

ExtrinsicsFormat urdf_format() {
  return {"urdf", write_urdf,
          [](const std::string& text) { return text.find("<robot") != std::string::npos; },
          read_urdf};
}

}  // namespace croon
