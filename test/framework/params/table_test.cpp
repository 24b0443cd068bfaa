#include "framework/params/choice.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/params/json_file.hpp"

namespace croon::params {
namespace {

enum class Word { one, two };
enum class Axis { x, y, z };

struct Base {
  int count = 3;
};

struct Sample : Base {
  double size_m = 0.5;
  bool flag = false;
  Word word = Word::one;
  std::string name = "a";
  std::vector<double> steps = {1.0, 0.5};
  std::vector<Axis> words = {Axis::x};
};

const Table<Sample>& sample_table() {
  static const Table<Sample> table =
      Table<Sample>{
          number("size_m", &Sample::size_m, {0.0, 10.0}, "Size.").formerly("extent_m"),
          boolean("flag", &Sample::flag, "Flag."),
          choice("word", &Sample::word, {{"one", Word::one}, {"two", Word::two}}, "Word."),
          choice("name", &Sample::name, {"a", "b"}, "A choice that is kept as a string."),
          numbers("steps", &Sample::steps, {0.1, 2.0}, "Steps."),
          choices("words", &Sample::words, {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}},
                  "Words."),
      }
          .inherit(Table<Base>{integer("count", &Base::count, {1, 9}, "Count.")})
          .require([](const Sample& s) { return s.count * s.size_m < 20.0; },
                   "too much for its size_m");
  return table;
}

/// Reads `text`, returns the parameters and puts the faults' lines into `lines`.
Sample read(const std::string& text, std::vector<std::string>& lines) {
  const nlohmann::json value = parse_json(text, "f");
  std::vector<Fault> faults;
  const Sample sample = sample_table().read(Node(value, "f", faults), {"type"}, NoStages());
  lines.clear();
  for (const Fault& fault : faults) lines.push_back(fault.line());
  return sample;
}

TEST(Table, InheritsRulesAndLastSteps) {
  Table<Base> base = {integer("count", &Base::count, {1, 9}, "Count.")};
  base.rule({"count", {}, false, {"flag"}, {}});
  base.finish([](Base& b, const Node&) { b.count *= 2; });
  Table<Sample> heir = {boolean("flag", &Sample::flag, "Flag.")};
  heir.inherit(base);
  std::vector<Fault> faults;
  const nlohmann::json whole = {{"count", 4}, {"flag", true}};
  EXPECT_EQ(heir.read(Node(whole, "f", faults), {}, NoStages()).count, 8);
  EXPECT_TRUE(faults.empty());
  const nlohmann::json without_flag = {{"count", 4}};
  heir.read(Node(without_flag, "f", faults), {}, NoStages());
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].message, "the key \"flag\" is missing");
}

TEST(Table, GivesDefaultsWhereNothingIsSaid) {
  std::vector<std::string> lines;
  const Sample sample = read(R"({"type": "t"})", lines);
  EXPECT_TRUE(lines.empty());
  EXPECT_EQ(
      sample_table().json(sample),
      R"({"size_m":0.5,"flag":false,"word":"one","name":"a","steps":[1,0.5],"words":["x"],"count":3})");
}

TEST(Table, ReadsEveryType) {
  std::vector<std::string> lines;
  const Sample sample = read(
      R"({"size_m": 2, "flag": true, "word": "two", "name": "b", "steps": [0.3], "words": ["z", "x"], "count": 4})",
      lines);
  EXPECT_TRUE(lines.empty());
  EXPECT_EQ(
      sample_table().json(sample),
      R"({"size_m":2,"flag":true,"word":"two","name":"b","steps":[0.3],"words":["z","x"],"count":4})");
}

TEST(Table, NotesEveryFaultWithItsPlace) {
  std::vector<std::string> lines;
  read(
      R"({"size": 2, "flag": 1, "word": "tow", "steps": [0.3, 5], "words": ["x", "x"], "count": 1.5})",
      lines);
  const std::vector<std::string> expected = {
      "f: /size: unknown key \"size\"; did you mean \"size_m\"?",
      "f: /flag: expected true or false, found 1",
      "f: /word: expected one of one, two, found \"tow\"; did you mean \"two\"?",
      "f: /steps/1: expected a number from 0.1 to 2, found 5",
      "f: /words/1: duplicate \"x\" in this list",
      "f: /count: expected a whole number, found 1.5",
  };
  EXPECT_EQ(lines, expected);
}

TEST(Table, RefusesEmptyLists) {
  std::vector<std::string> lines;
  read(R"({"steps": [], "words": "x"})", lines);
  const std::vector<std::string> expected = {
      "f: /steps: expected a list of at least one number, found []",
      "f: /words: expected a list, found \"x\"",
  };
  EXPECT_EQ(lines, expected);
}

TEST(Table, ChecksConditionsOnWhatCouldBeRead) {
  std::vector<std::string> lines;
  read(R"({"count": 9, "size_m": 10})", lines);
  EXPECT_EQ(lines, std::vector<std::string>{"f: /: too much for its size_m, found 10"});
  read(R"({"count": 9, "size_m": "ten"})", lines);
  EXPECT_EQ(lines, std::vector<std::string>{"f: /size_m: expected a number, found \"ten\""});
}

TEST(Table, ReadsTheFormerNameOfAKeyWithANote) {
  std::vector<Fault> faults, notes;
  const nlohmann::json former = {{"extent_m", 2}};
  const Node node(former, "f", faults, {{"extent_m", {"g", "extent_m"}}});
  const Sample sample = sample_table().read(node.noting(notes), {}, NoStages());
  EXPECT_EQ(sample_table().json(sample).rfind(R"({"size_m":2,)", 0), 0U);
  sample_table().read(node.noting(notes), {}, NoStages());
  EXPECT_TRUE(faults.empty());
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].line(), "g: /extent_m: the key \"extent_m\" is now called \"size_m\"");
}

TEST(Table, ReportsFaultsUnderTheWrittenName) {
  std::vector<std::string> lines;
  read(R"({"extent_m": 11})", lines);
  EXPECT_EQ(lines,
            std::vector<std::string>{"f: /extent_m: expected a number from 0 to 10, found 11"});
  read(R"({"extent_m": 1, "size_m": 2})", lines);
  EXPECT_EQ(lines, std::vector<std::string>{
                       "f: /extent_m: expected \"size_m\" without its former name, found both"});
  read(R"({"extent": 1})", lines);
  EXPECT_EQ(lines.at(0).find("extent_m"), std::string::npos) << lines[0];
}

TEST(RangeWords, SayTheBounds) {
  EXPECT_EQ(range_words("a number", {0, 10}), "a number from 0 to 10");
  EXPECT_EQ(range_words("a number", {1}), "a number of at least 1");
  EXPECT_EQ(range_words("a number", {}), "a number");
}

}  // namespace
}  // namespace croon::params
