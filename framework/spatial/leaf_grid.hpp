#pragma once

#include <Eigen/Core>
#include <array>
#include <sstream>

#include "framework/base/error.hpp"

namespace croon {

/// std::floor for values that fit an int; without SSE 4.1, std::floor is a library call.
inline int floor_of(double value) {
  const int towards_zero = static_cast<int>(value);
  return towards_zero - static_cast<int>(value < towards_zero);
}

/// The grid of cubes that all volume scorers and the voxel filter share: leaf (i, j, k) contains
/// the points p with `i = floor(x / leaf_size)` and so on, in the frame of the points. All scorers
/// use this function, so their counts are exactly equal.
class LeafGrid {
 public:
  /// Indices range from -kMaxIndex to kMaxIndex: with leaves of 5 cm, 26 000 km from the origin.
  static constexpr int kMaxIndex = 1 << 29;

  explicit LeafGrid(double leaf_size_m) : leaf_size_m_(leaf_size_m), inverse_(1.0 / leaf_size_m) {}

  /// The leaf that contains `point`. Throws StageError if an index would exceed kMaxIndex or the
  /// point is not finite.
  Eigen::Vector3i leaf_of(const Eigen::Vector3d& point) const {
    const Eigen::Array3d scaled = point.array() * inverse_;
    // Negated, so that NaN is refused too.
    if (!(scaled.abs() <= kMaxIndex).all()) refuse(point);
    return {floor_of(scaled.x()), floor_of(scaled.y()), floor_of(scaled.z())};
  }
  double leaf_size_m() const { return leaf_size_m_; }
  /// The factor that leaf_of multiplies by: the rounded reciprocal of the leaf size.
  double leaves_per_m() const { return inverse_; }

 private:
  [[noreturn]] void refuse(const Eigen::Vector3d& point) const {
    std::ostringstream message;
    message << "a point at (" << point.x() << ", " << point.y() << ", " << point.z()
            << ") m is outside the grid of leaves: with a leaf size of " << leaf_size_m_
            << " m, coordinates are limited to " << kMaxIndex * leaf_size_m_ << " m";
    throw StageError(message.str());
  }

  double leaf_size_m_;
  double inverse_;
};

/// A leaf as an element of sets and a key of maps, ordered by i, then j, then k.
using LeafKey = std::array<int, 3>;

inline LeafKey leaf_key(const Eigen::Vector3i& leaf) { return {leaf.x(), leaf.y(), leaf.z()}; }

}  // namespace croon
