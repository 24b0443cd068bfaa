#include "test/support/nested_stage.hpp"

#include "framework/params/choice.hpp"
#include "framework/params/group.hpp"
#include "framework/stage/dataset.hpp"

namespace croon::test {
namespace {

enum class Pattern { even, dense_middle };

struct Model {
  int rings = 16;
  double far_m = 100.0;
  Pattern pattern = Pattern::even;
};

struct Mount {
  double height_m = 2.0;
  Model model;
};

struct Rig {
  std::string reference;
  std::vector<std::pair<std::string, Mount>> sensors;
};

struct Mix {
  double urban = 3.0;
  double highway = 1.0;
};

struct Params {
  Model model;
  Mix mix;
  Rig rig;
};

const params::Table<Params>& table() {
  static const params::Table<Model> model_table = {
      params::integer("rings", &Model::rings, {1, 128}, "Rings of the sensor."),
      params::number("far_m", &Model::far_m, {1, 1000}, "Longest range."),
      params::choice("pattern", &Model::pattern,
                     {{"even", Pattern::even}, {"dense_middle", Pattern::dense_middle}},
                     "Where rings stand."),
  };
  static const std::vector<params::Preset<Model>> models = {{"coarse", {}},
                                                            {"fine", {64, 200.0, Pattern::even}}};
  static const params::Table<Mix> mix_table =
      params::Table<Mix>{
          params::number("urban", &Mix::urban, {0, 100}, "Share of urban scenes."),
          params::number("highway", &Mix::highway, {0, 100}, "Share of highways."),
      }
          .require([](const Mix& m) { return m.urban + m.highway > 0; }, "expected a share");
  static const params::Table<Mount> mount_table = {
      params::number("height_m", &Mount::height_m, {0, 5}, "Height above the road."),
      params::group("model", &Mount::model, model_table, models, "The sensor's model."),
  };
  static const params::Table<Rig> rig_table = {
      params::text("reference", &Rig::reference, "The reference's name."),
      params::map("sensors", &Rig::sensors, mount_table, "a sensor's name", "The sensors."),
  };
  static const std::vector<params::Preset<Rig>> rigs = {
      {"pair", {"front", {{"front", {}}, {"top", {2.5, {64, 200.0, Pattern::even}}}}}}};
  static const params::Table<Params> table = {
      params::group("model", &Params::model, model_table, models, "The model of all."),
      params::group("mix", &Params::mix, mix_table, {}, "The shares of the kinds of scenes."),
      params::group("rig", &Params::rig, rig_table, rigs, "The sensors on the car."),
  };
  return table;
}

class Nested final : public Dataset {
 public:
  explicit Nested(const Params&) {}
  std::vector<Scene> scenes(const std::filesystem::path&) const override { return {}; }
};

}  // namespace

StageEntry nested_stage() {
  return stage_entry<Nested>("nested", "Scenes of a rig that is an object.", "croon", table());
}

}  // namespace croon::test
