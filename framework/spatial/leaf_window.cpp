#include "framework/spatial/leaf_window.hpp"

#include <cstring>

namespace croon {

PointColumns::PointColumns(const Points& points) {
  if (points.empty()) return;
  Eigen::Array3f low = points[0].array();
  Eigen::Array3f high = low;
  for (std::vector<float>* column : {&x, &y, &z}) column->reserve(points.size());
  for (const Eigen::Vector3f& point : points) {
    x.push_back(point.x());
    y.push_back(point.y());
    z.push_back(point.z());
    low = low.min(point.array());
    high = high.max(point.array());
    finite = finite && point.allFinite();
  }
  centre = (low.cast<double>() + high.cast<double>()) / 2;
  reach = (high.cast<double>() - low.cast<double>()) / 2;
}

std::int64_t count_new(const FarLeaves& leaves, const FarLeaves& others) {
  return std::count_if(leaves.begin(), leaves.end(), [&](const LeafKey& leaf) {
    return !std::binary_search(others.begin(), others.end(), leaf);
  });
}

namespace {

/// The inputs of a key that depend on the pose and the window.
struct Pose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  double leaves_per_m;
  Eigen::Vector3d shift;  ///< kToBits minus the window's corner.
};

/// 1.5 * 2^52: adding a smaller number rounds it to an integer.
constexpr double kToInteger = 6755399441055744.0;
/// 2^52: the low bits of the sum with a smaller natural number contain that number.
constexpr double kToBits = 4503599627370496.0;

#define CROON_INLINE inline __attribute__((always_inline))

/// floor(scaled) minus the window's corner, in [0, 2^21). Avoids conversions to int, which have
/// half the vector width of doubles, and floor, which SSE2 lacks.
CROON_INLINE std::uint64_t offset_of(double scaled, double shift) {
  const double nearest = (scaled + kToInteger) - kToInteger;
  const double shifted = nearest + shift;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &shifted, sizeof bits);
  return (bits - static_cast<std::uint64_t>(nearest > scaled)) & 0x1fffff;
}

/// The compiler vectorises this loop. The order of the sums is that in which Eigen computes
/// `rotation * point + translation`, so the result is bitwise that of `RigidTransform`.
CROON_INLINE void transform_and_key(const float* xs, const float* ys, const float* zs,
                                    std::size_t count, const Pose& pose, std::uint64_t* keys) {
  const Eigen::Matrix3d R = pose.rotation;
  const double r00 = R(0, 0), r01 = R(0, 1), r02 = R(0, 2), tx = pose.translation.x();
  const double r10 = R(1, 0), r11 = R(1, 1), r12 = R(1, 2), ty = pose.translation.y();
  const double r20 = R(2, 0), r21 = R(2, 1), r22 = R(2, 2), tz = pose.translation.z();
  const double shift_x = pose.shift.x(), shift_y = pose.shift.y(), shift_z = pose.shift.z();
  const double leaves_per_m = pose.leaves_per_m;
  for (std::size_t n = 0; n < count; ++n) {
    const double x = xs[n];
    const double y = ys[n];
    const double z = zs[n];
    const double u = ((r00 * x + r01 * y) + r02 * z) + tx;
    const double v = ((r10 * x + r11 * y) + r12 * z) + ty;
    const double w = (r20 * x + (r21 * y + r22 * z)) + tz;
    keys[n] =
        LeafWindow::key(offset_of(u * leaves_per_m, shift_x), offset_of(v * leaves_per_m, shift_y),
                        offset_of(w * leaves_per_m, shift_z));
  }
}

void transform_and_key_sse2(const float* xs, const float* ys, const float* zs, std::size_t count,
                            const Pose& pose, std::uint64_t* keys) {
  transform_and_key(xs, ys, zs, count, pose, keys);
}

#ifdef __x86_64__
#define CROON_AVX2 __attribute__((target("avx2")))
#else
#define CROON_AVX2
#endif

/// The same code with instructions of twice the width.
CROON_AVX2 void transform_and_key_avx2(const float* xs, const float* ys, const float* zs,
                                       std::size_t count, const Pose& pose, std::uint64_t* keys) {
  transform_and_key(xs, ys, zs, count, pose, keys);
}

}  // namespace

LeafWindow::Instructions LeafWindow::best_instructions() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") != 0) return Instructions::avx2;
#endif
  return Instructions::any_processor;
}

LeafWindow::LeafWindow(const LeafGrid& grid, const Eigen::Vector3d& centre)
    : grid_(grid), corner_(grid.leaf_of(centre).array() - kWidth / 2) {}

LeafWindow::LeafWindow(const LeafGrid& grid, const PointColumns& points,
                       const RigidTransform& T_grid_points)
    : LeafWindow(grid, points.size() == 0
                           ? Eigen::Vector3d::Zero().eval()
                           : (T_grid_points * points.point(points.size() / 2)).eval()) {}

bool LeafWindow::contains(const PointColumns& points, const RigidTransform& T_target_source) const {
  if (!points.finite) return false;
  const Eigen::Matrix3d spread = T_target_source.rotation.cwiseAbs();
  const Eigen::Vector3d reach = spread * points.reach;
  // Rounding moves a point by less than a part in 10^12 of the summands, plus a leaf.
  const Eigen::Vector3d rounding =
      1e-12 * (spread * points.centre.cwiseAbs() + reach + T_target_source.translation.cwiseAbs());
  const Eigen::Array3d from_centre =
      (T_target_source * points.centre).array() * grid_.leaves_per_m() -
      corner_.array().cast<double>() - 0.5 * kWidth;
  const Eigen::Array3d extent = (reach + rounding).array() * grid_.leaves_per_m() + 2.0;
  // The window of a cloud at the border of the grid extends beyond it.
  const Eigen::Array3d from_zero = (T_target_source * points.centre).array() * grid_.leaves_per_m();
  // Comparisons with NaN are false.
  return (from_centre.abs() + extent < 0.5 * kWidth).all() &&
         (from_zero.abs() + extent < LeafGrid::kMaxIndex).all();
}

void LeafWindow::compute_keys(const PointColumns& points, const RigidTransform& T_target_source,
                              std::size_t first, std::size_t count, Instructions instructions,
                              std::uint64_t* keys) const {
  const Pose pose = {T_target_source.rotation, T_target_source.translation, grid_.leaves_per_m(),
                     kToBits - corner_.cast<double>().array()};
  const auto compute =
      instructions == Instructions::avx2 ? transform_and_key_avx2 : transform_and_key_sse2;
  compute(points.x.data() + first, points.y.data() + first, points.z.data() + first, count, pose,
          keys);
}

void LeafWindow::sort_each_once(FarLeaves& leaves) {
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
}

}  // namespace croon
