#pragma once

#include <span>
#include <vector>

#include "bie/potentials/kernel_columns.hpp"
#include "bie/potentials/rotated_quadrature.hpp"

namespace vehd {

/// A node of the target grid.
struct Target {
  int latitude = 0;
  double phi = 0.0;
  Vector3 position;
  Vector3 area_vector;  ///< J n
  Index row = 0;        ///< where its kernel rows go
};

/// Harmonic coefficients of many columns in the rectangular layout [m][n][column], cosines and sines apart: rows of
/// one m are contiguous (Legendre sums), rows of one n have a constant stride (Wigner blocks).
class CoefficientBlock {
 public:
  using Block = Eigen::Map<RowMatrix, 0, Eigen::OuterStride<>>;

  CoefficientBlock(int order, Index columns)
      : width_(order + 1),
        columns_(columns),
        cosine_(width_ * width_ * columns, 0.0),
        sine_(width_ * width_ * columns, 0.0) {}

  double* row(bool sine, int n, int m) { return (sine ? sine_ : cosine_).data() + (m * width_ + n) * columns_; }
  const double* row(bool sine, int n, int m) const {
    return (sine ? sine_ : cosine_).data() + (m * width_ + n) * columns_;
  }
  /// Degrees m..p of order m.
  Block order_block(bool sine, int m) {
    return {row(sine, m, m), width_ - m, columns_, Eigen::OuterStride<>(columns_)};
  }
  /// Orders first..n of degree n.
  Block degree_block(bool sine, int n, int first) {
    return {row(sine, n, first), n + 1 - first, columns_, Eigen::OuterStride<>(width_ * columns_)};
  }

 private:
  Index width_;
  Index columns_;
  std::vector<double> cosine_;
  std::vector<double> sine_;
};

/// Work of one thread: the kernel rows of a chunk of targets, which share the matrix products. Targets of one latitude
/// stand together.
class TargetRows {
 public:
  TargetRows(const RotatedQuadrature& quadrature, const KernelColumns& kernels, const Matrix& position,
             int azimuthal_order, int chunk);

  /// Fills rows of `rows`, [targets x kernels * active coefficients], coefficients in order-major order.
  /// @param targets  as many as the chunk
  void run(std::span<const Target> targets, RowMatrix& rows);

 private:
  static constexpr int kShapeKinds = 3;  ///< x, ∂x/∂θ, ∂x/(sin θ ∂φ) in the rotated frame

  [[nodiscard]] Index row_columns() const { return Index{kernels_.count} * chunk_; }
  void load_shape(std::span<const Target> targets);
  void rotate(std::span<const Target> targets);
  void synthesize_shape();
  void evaluate_kernels(std::span<const Target> targets);
  void collect_rows();
  void rotate_back(std::span<const Target> targets);
  void store_rows(std::span<const Target> targets, RowMatrix& rows) const;

  const RotatedQuadrature& q_;
  const KernelColumns& kernels_;
  const Matrix& position_;
  int chunk_;
  int order_;
  int azimuthal_order_;
  CoefficientBlock shape_, rotated_shape_, rows_, rotated_rows_;
  int shape_kinds_;
  RowMatrix product_, product_sine_, ce_, se_, co_, so_, values_;
  RowMatrix even_cosine_[kShapeKinds], even_sine_[kShapeKinds], odd_cosine_[kShapeKinds], odd_sine_[kShapeKinds];
  RowMatrix nodes_[kShapeKinds];
  Matrix distance_;  ///< r and 1/|r| of the targets at one node
};

}  // namespace vehd
