#include "framework/params/choice.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::preprocessor {
namespace {

enum class Keep { outside, inside };

struct Params {
  std::vector<double> min_m = {-1.0, -1.0, -1.0};
  std::vector<double> max_m = {1.0, 1.0, 1.0};
  Keep keep = Keep::outside;
};

bool is_box(const Params& params) {
  if (params.min_m.size() != 3 || params.max_m.size() != 3) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (params.min_m[axis] > params.max_m[axis]) return false;
  }
  return true;
}

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::numbers("min_m", &Params::min_m, {-1e6, 1e6},
                        "The box's lower corner x, y, z in the sensor's frame."),
        params::numbers("max_m", &Params::max_m, {-1e6, 1e6},
                        "The box's upper corner x, y, z in the sensor's frame."),
        params::choice("keep", &Params::keep,
                       {{"outside", Keep::outside}, {"inside", Keep::inside}},
                       "Points that are kept; the faces of the box count as inside."),
    };
    rows.require(is_box,
                 "min_m and max_m must have three numbers each, and min_m must not exceed max_m on "
                 "any axis");
    return rows;
  }();
  return table;
}

class BoxCrop final : public Preprocessor {
 public:
  explicit BoxCrop(const Params& params)
      : low_(params.min_m.data()),
        high_(params.max_m.data()),
        keeps_inside_(params.keep == Keep::inside) {}

  PointCloud apply(const PointCloud& cloud) const override {
    return filtered(cloud, [&](std::size_t i) {
      const Eigen::Array3d p = cloud.points[i].cast<double>().array();
      const bool is_inside = (p >= low_).all() && (p <= high_).all();
      return is_inside == keeps_inside_ && p.allFinite();
    });
  }

 private:
  Eigen::Array3d low_, high_;
  bool keeps_inside_;
};

}  // namespace

StageEntry box_crop() {
  return stage_entry<BoxCrop>(
      "box_crop",
      "Removes the points inside a box around the sensor, such as those on the car's body.",
      "croon", table());
}

}  // namespace croon::stages::preprocessor
