#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace croon {

/// The position of a parameter block, e.g. of a pose, among all unknowns of a least squares
/// problem. A block without unknowns is constant.
struct Block {
  Eigen::Index at = 0;
  Eigen::Index size = 0;

  /// Whether it is not constant.
  explicit operator bool() const { return size > 0; }
};

/// Appends a block to `unknowns` unknowns, and adds its size to their number.
inline Block appended_block(Eigen::Index size, Eigen::Index& unknowns) {
  unknowns += size;
  return {unknowns - size, size};
}

/// The derivatives of a cost with respect to unknowns in blocks. Terms of constant blocks are
/// ignored; the others are added in the order of the calls.
struct BlockSystem {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;

  /// A system without terms.
  static BlockSystem zero(Eigen::Index unknowns) {
    return {Eigen::VectorXd::Zero(unknowns), Eigen::MatrixXd::Zero(unknowns, unknowns)};
  }

  /// Adds to the gradient with respect to `a`.
  template <class Vector>
  void add(const Block& a, const Eigen::MatrixBase<Vector>& term) {
    if (a) gradient.segment<Vector::RowsAtCompileTime>(a.at, a.size) += term.derived();
  }

  /// Adds to the Hessian with respect to `a` and `b`, but not to that with respect to `b` and `a`.
  template <class Matrix>
  void add(const Block& a, const Block& b, const Eigen::MatrixBase<Matrix>& term) {
    constexpr int kRows = Matrix::RowsAtCompileTime, kColumns = Matrix::ColsAtCompileTime;
    if (a && b) hessian.block<kRows, kColumns>(a.at, b.at, a.size, b.size) += term.derived();
  }

  /// Adds all derivatives of a term that depends on `blocks`; `from` contains the index of the
  /// first unknown of each in `term_gradient` and `term_hessian`.
  template <std::size_t N, class Vector, class Matrix>
  void add(const std::array<Block, N>& blocks, const std::array<int, N>& from,
           const Eigen::PlainObjectBase<Vector>& term_gradient,
           const Eigen::PlainObjectBase<Matrix>& term_hessian) {
    for (std::size_t i = 0; i < N; ++i) {
      const Block& a = blocks[i];
      add(a, term_gradient.segment(from[i], a.size));
      for (std::size_t j = 0; j < N; ++j) {
        add(a, blocks[j], term_hessian.block(from[i], from[j], a.size, blocks[j].size));
      }
    }
  }
};

}  // namespace croon
