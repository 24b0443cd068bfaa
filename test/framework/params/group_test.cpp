#include "framework/params/group.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/params/json_file.hpp"

namespace croon::params {
namespace {

struct Model {
  int rings = 16;
  double near_m = 1.0;
  double far_m = 100.0;
};

struct Mount {
  double height_m = 2.0;
  Model model;
};

struct Rig {
  std::string reference;
  std::vector<std::pair<std::string, Mount>> sensors;
};

Model with_rings(int rings) { return {rings, 1.0, 100.0}; }

struct Nested {
  Model model = with_rings(64);
  Rig rig;
};

const Table<Model>& model_table() {
  static const Table<Model> table =
      Table<Model>{
          integer("rings", &Model::rings, {1, 128}, "Rings."),
          number("near_m", &Model::near_m, {0, 1000}, "Nearest."),
          number("far_m", &Model::far_m, {0, 1000}, "Farthest."),
      }
          .require([](const Model& m) { return m.near_m < m.far_m; }, "expected near before far");
  return table;
}

const std::vector<Preset<Model>> kModels = {{"coarse", {}}, {"fine", with_rings(64)}};

const Table<Rig>& rig_table() {
  static const Table<Mount> mount_table = {
      number("height_m", &Mount::height_m, {0, 9}, "Height."),
      group("model", &Mount::model, model_table(), kModels, "Model."),
  };
  static const Table<Rig> table = {
      text("reference", &Rig::reference, "Reference."),
      map("sensors", &Rig::sensors, mount_table, "a sensor's name", "Sensors."),
  };
  return table;
}

const Table<Nested>& table() {
  const Mount fine{2.0, with_rings(64)};
  static const Table<Nested> table = {
      group("model", &Nested::model, model_table(), kModels, "Model."),
      group("rig", &Nested::rig, rig_table(), {{"pair", {"a", {{"a", fine}, {"b", {}}}}}}, "Rig."),
  };
  return table;
}

/// The lines of the faults in `text`; `sample` gets what was read.
std::vector<std::string> faults_of(const std::string& text, Nested& sample) {
  const nlohmann::json value = parse_json(text, "f");
  std::vector<Fault> faults;
  sample = table().read(Node(value, "f", faults), {}, NoStages());
  std::vector<std::string> lines;
  for (const Fault& fault : faults) lines.push_back(fault.line());
  return lines;
}

std::vector<std::string> faults_of(const std::string& text) {
  Nested sample;
  return faults_of(text, sample);
}

/// What the parameter `key` of the object `text` is when it was read, as JSON text.
std::string resolved(const std::string& text, const std::string& key) {
  Nested sample;
  EXPECT_EQ(faults_of(text, sample), std::vector<std::string>{}) << text;
  return nlohmann::json::parse(table().json(sample))[key].dump();
}

std::string model_json(int rings, double far_m = 100.0) {
  return R"({"far_m":)" + value_json(far_m) + R"(,"near_m":1,"rings":)" + value_json(rings) + "}";
}

std::string mount_json(double height_m, int rings) {
  return R"({"height_m":)" + value_json(height_m) + R"(,"model":)" + model_json(rings) + "}";
}

TEST(Group, IsAPresetAnObjectOrBoth) {
  const std::string rig = R"("rig":"pair"})";
  const auto model = [&](const std::string& value) {
    return resolved(R"({"model":)" + value + "," + rig, "model");
  };
  EXPECT_EQ(resolved("{" + rig, "model"), model_json(64));
  EXPECT_EQ(model(R"("coarse")"), model_json(16));
  EXPECT_EQ(model(R"({"far_m": 50})"), model_json(16, 50));
  EXPECT_EQ(model(R"({"like": "fine", "far_m": 50})"), model_json(64, 50));
  EXPECT_EQ(model(R"({"like": "fine"})"), model_json(64));
  EXPECT_EQ(model("{}"), model_json(16));
}

TEST(Group, HoldsGroupsAndMaps) {
  EXPECT_EQ(resolved(R"({"rig": "pair"})", "rig"), R"({"reference":"a","sensors":{"a":)" +
                                                       mount_json(2, 64) + R"(,"b":)" +
                                                       mount_json(2, 16) + "}}");
  EXPECT_EQ(resolved(R"({"rig": {"like": "pair",
                                 "sensors": {"z-1": {"model": "fine"}, "B_2": {"height_m": 1}}}})",
                     "rig"),
            R"({"reference":"a","sensors":{"B_2":)" + mount_json(1, 16) + R"(,"z-1":)" +
                mount_json(2, 64) + "}}");
}

TEST(Group, KeepsAMapInTheOrderOfItsNames) {
  Nested sample;
  faults_of(R"({"rig": {"like": "pair", "sensors": {"c": {}, "a": {}, "b": {}}}})", sample);
  ASSERT_EQ(sample.rig.sensors.size(), 3U);
  EXPECT_EQ(sample.rig.sensors[0].first, "a");
  EXPECT_EQ(sample.rig.sensors[1].first, "b");
  EXPECT_EQ(sample.rig.sensors[2].first, "c");
}

TEST(Group, NotesEveryFaultWithItsPlace) {
  const std::vector<std::string> expected = {
      "f: /model/ring: unknown key \"ring\"; did you mean \"rings\"?",
      "f: /model/near_m: expected a number from 0 to 1000, found -1",
      "f: /rig/reference: expected a string, found 1",
      "f: /rig/sensors/a.b: expected a sensor's name, a name of letters, digits, _ and -, not "
      "starting with -, found \"a.b\"",
      "f: /rig/sensors/b: expected an object, found \"fine\"",
      "f: /rig/sensors/c/model: expected one of coarse, fine or an object, found \"fin\"; did you "
      "mean \"fine\"?",
      "f: /rig/sensors/d/model/like: expected one of coarse, fine, found \"corse\"; did you mean "
      "\"coarse\"?",
      "f: /rig/sensors/d/model/rings: expected a whole number, found 0.5",
      "f: /rig/sensors/e/model: expected one of coarse, fine or an object, found 5",
      "f: /rig/sensors/f/model: expected near before far"};
  EXPECT_EQ(faults_of(R"({"model": {"ring": 2, "near_m": -1},
                          "rig": {"reference": 1,
                                  "sensors": {"a.b": {},
                                              "b": "fine",
                                              "c": {"model": "fin"},
                                              "d": {"model": {"like": "corse", "rings": 0.5}},
                                              "e": {"model": 5},
                                              "f": {"model": {"near_m": 200}}}}})"),
            expected);
}

TEST(Group, RequiresWhatNoPresetGives) {
  EXPECT_EQ(faults_of("{}"), std::vector<std::string>{"f: /: the key \"rig\" is missing"});
  EXPECT_EQ(faults_of(R"({"rig": {}})"),
            (std::vector<std::string>{"f: /rig: the key \"reference\" is missing",
                                      "f: /rig: the key \"sensors\" is missing"}));
  EXPECT_EQ(faults_of(R"({"rig": {"like": "pear"}})"),
            std::vector<std::string>{
                "f: /rig/like: expected one of pair, found \"pear\"; did you mean \"pair\"?"});
  EXPECT_EQ(faults_of(R"({"rig": {"reference": "a", "sensors": {}}})"),
            std::vector<std::string>{"f: /rig/sensors: expected an object with a sensor's name for "
                                     "each key, found {}"});
}

TEST(Group, TellsItsMembersAndDefaults) {
  const std::vector<ParameterDoc> docs = table().docs();
  EXPECT_EQ(docs[0].type, ParameterType::group);
  EXPECT_EQ(docs[0].choices, (std::vector<std::string>{"coarse", "fine"}));
  EXPECT_EQ(docs[0].default_json, R"("fine")");
  EXPECT_FALSE(docs[0].is_required);
  EXPECT_EQ(docs[0].members.size(), 3U);
  EXPECT_TRUE(docs[1].is_required);
  const ParameterDoc& sensors = docs[1].members[1];
  EXPECT_EQ(sensors.type, ParameterType::map);
  EXPECT_EQ(sensors.name_words, "a sensor's name");
  EXPECT_TRUE(sensors.is_required);
  EXPECT_EQ(sensors.members[1].default_json, R"("coarse")");
}

struct Heir : Nested {
  Heir() { model.far_m = 50; }
};

TEST(Group, HasTheDefaultOfTheStructThatInheritsIt) {
  const std::vector<ParameterDoc> docs = Table<Heir>().inherit(table()).docs();
  EXPECT_EQ(docs[0].default_json, R"({"rings":64,"near_m":1,"far_m":50})");
}

TEST(Group, WithoutPresetsIsAnObject) {
  const Table<Mount> plain = {group("model", &Mount::model, model_table(), {}, "Model.")};
  EXPECT_EQ(plain.docs()[0].default_json, R"({"rings":16,"near_m":1,"far_m":100})");
  std::vector<Fault> faults;
  const nlohmann::json word = {{"model", "fine"}};
  plain.read(Node(word, "f", faults), {}, NoStages());
  const nlohmann::json like = {{"model", {{"like", "fine"}}}};
  plain.read(Node(like, "f", faults), {}, NoStages());
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].line(), "f: /model: expected an object, found \"fine\"");
  EXPECT_EQ(faults[1].where, "/model/like");
}

TEST(Map, RefusesADefaultOutOfTheOrderOfItsNames) {
  const Table<Rig>& rigs = rig_table();
  EXPECT_THROW(rigs.json(Rig{"a", {{"b", {}}, {"a", {}}}}), std::logic_error);
  EXPECT_THROW(rigs.json(Rig{"a", {{"a", {}}, {"a", {}}}}), std::logic_error);
}

struct Kind {
  static constexpr const char* kKind = "icp";
};
struct WithStage {
  Slot<Kind> stage;
};
struct Outer {
  WithStage inner;
};

TEST(Group, RefusesAStageInIt) {
  const Table<WithStage> inner = {slot("stage", &WithStage::stage, "{}", "Stage.")};
  EXPECT_THROW(group("inner", &Outer::inner, inner, {}, "Inner."), std::logic_error);
}

}  // namespace
}  // namespace croon::params
