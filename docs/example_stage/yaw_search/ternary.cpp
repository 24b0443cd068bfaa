#include "framework/base/angles.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::stages::yaw_search {
namespace {

struct Params {
  double range_deg = 60.0;
  double tolerance_deg = 0.05;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("range_deg", &Params::range_deg, {0.01, 180.0},
                     "How far the search looks to each side of the start."),
      params::number("tolerance_deg", &Params::tolerance_deg, {1e-6, 180.0},
                     "The search ends where the interval is no wider than this."),
  };
  return table;
}

/// Ternary search: of an interval's three thirds, the one beyond the dearer of the two inner ends
/// cannot hold the least of a function that falls and then rises, and is cut off.
class Ternary final : public YawSearch {
 public:
  explicit Ternary(const Params& params) : params_(params) {}

  YawMinimum minimise(const YawCost& cost) const override {
    double low_rad = -rad_from_deg(params_.range_deg);
    double high_rad = -low_rad;
    int evaluations = 0;
    while (high_rad - low_rad > rad_from_deg(params_.tolerance_deg)) {
      const double third_rad = (high_rad - low_rad) / 3.0;
      const bool is_left_cheaper = cost(low_rad + third_rad) < cost(high_rad - third_rad);
      (is_left_cheaper ? high_rad : low_rad) += is_left_cheaper ? -third_rad : third_rad;
      evaluations += 2;
    }
    const double yaw_rad = 0.5 * (low_rad + high_rad);
    return {yaw_rad, cost(yaw_rad), evaluations + 1};
  }

 private:
  Params params_;
};

}  // namespace

StageEntry ternary() {
  return stage_entry<Ternary>("ternary",
                              "Cuts off the dearer third of the interval again and again.",
                              "the example of docs/extending.md", table());
}

}  // namespace croon::stages::yaw_search
