#pragma once

#include <array>
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

  /// @param highest  m
  CoefficientBlock(int order, int highest, Index cosine_columns, Index sine_columns)
      : width_(order + 1),
        columns_{cosine_columns, sine_columns},
        values_{std::vector<double>((highest + 1) * width_ * cosine_columns, 0.0),
                std::vector<double>((highest + 1) * width_ * sine_columns, 0.0)} {}

  [[nodiscard]] Index columns(bool sine) const { return columns_[sine]; }
  double* row(bool sine, int n, int m) { return values_[sine].data() + (m * width_ + n) * columns_[sine]; }
  const double* row(bool sine, int n, int m) const { return values_[sine].data() + (m * width_ + n) * columns_[sine]; }
  /// Degrees m..p of order m.
  Block order_block(bool sine, int m) {
    return {row(sine, m, m), width_ - m, columns_[sine], Eigen::OuterStride<>(columns_[sine])};
  }
  /// Orders first..last of degree n.
  Block degree_block(bool sine, int n, int first, int last) {
    return {row(sine, n, first), last + 1 - first, columns_[sine], Eigen::OuterStride<>(width_ * columns_[sine])};
  }

 private:
  Index width_;
  std::array<Index, 2> columns_;
  std::array<std::vector<double>, 2> values_;
};

/// What a column is in Fourier sums about the target: without a mirror each one has cosines and sines.
struct FourierColumns {
  std::vector<int> cosine, sine;

  [[nodiscard]] const std::vector<int>& of(bool is_sine) const { return is_sine ? sine : cosine; }
  [[nodiscard]] std::size_t count() const { return cosine.size() + sine.size(); }
};

/// Of the components of x; `mirrored`: about a target in a plane of symmetry y = 0.
FourierColumns shape_columns(bool mirrored);
/// Likewise of the kernels.
FourierColumns row_columns(const KernelColumns& kernels, bool mirrored);

/// Where the values of one column lie along an azimuth: of node i at start + i * stride, for all targets of the chunk.
struct ColumnPlace {
  Index start = 0;
  Index stride = 0;
};

/// Work of one thread: the kernel rows of a chunk of targets, which share the matrix products. Targets of one latitude
/// stand together. Where all targets lie in a plane of symmetry y = 0, what they see at azimuths φ and −φ about them is
/// equal up to signs, so that one half of the nodes is enough.
/// Source: Gimbutas and Veerapaneni 2013 for phase shift, rotation and synthesis; here the same chain runs backwards as
/// well, so that a kernel row becomes a row over coefficients
class TargetRows {
 public:
  /// @param position  coefficients of x, [n_coefficients x 3]; it and the other references must outlive the rows
  /// @param chunk     targets at a time
  /// @param mirrored  all targets lie in a plane of symmetry y = 0
  TargetRows(const RotatedQuadrature& quadrature, const KernelColumns& kernels, const Matrix& position,
             int azimuthal_order, int chunk, bool mirrored);

  /// Fills rows of `rows`, [targets x kernels * active coefficients], coefficients in order-major order.
  /// @param targets  as many as the chunk
  void run(std::span<const Target> targets, RowMatrix& rows);

 private:
  static constexpr int kShapeKinds = 3;  ///< x, ∂x/∂θ, ∂x/(sin θ ∂φ) in the rotated frame

  /// Columns of cosines alone first, then those of sines; all at once without a mirror.
  [[nodiscard]] std::vector<ColumnPlace> places_of(const std::vector<int>& first, const std::vector<int>& second) const;
  void phase_shift(std::span<const Target> targets);
  void rotate(std::span<const Target> targets);
  void synthesize_shape();
  void evaluate_kernels(std::span<const Target> targets);
  void adjoint_synthesis();
  void rotate_back(std::span<const Target> targets);
  /// Orders of one degree, up to the highest.
  struct Orders {
    CoefficientBlock& block;
    int highest;
  };
  /// Orders of degree n of every target by its own rotation, or by its transpose.
  void rotate_one_by_one(std::span<const Target> targets, int n, const Orders& from, const Orders& to, bool back);
  /// What the rotation of each target has at one place of the blocks of degree n.
  void load_rotation_entries(std::span<const Target> targets, bool sine, int n, int after, int before);
  /// to += rotation_entries · from, for every one of the columns, which have as many entries as there are targets.
  void add_rotated(double* to, const double* from, Index columns) const;
  void store_rows(std::span<const Target> targets, RowMatrix& rows) const;

  const RotatedQuadrature& q_;
  const KernelColumns& kernels_;
  const Matrix& position_;
  int chunk_;
  int order_;
  int azimuthal_order_;
  bool mirrored_;
  int n_azimuths_;
  FourierColumns components_, kernel_columns_;
  CoefficientBlock shape_, rotated_shape_, rows_, rotated_rows_;
  int shape_kinds_;
  RowMatrix product_, product_sine_, ce_, se_, co_, so_, values_;
  RowMatrix even_cosine_[kShapeKinds], even_sine_[kShapeKinds], odd_cosine_[kShapeKinds], odd_sine_[kShapeKinds];
  RowMatrix nodes_[kShapeKinds];
  std::vector<ColumnPlace> component_places_[kShapeKinds], kernel_places_;
  std::vector<double> rotation_entries_;
  Matrix distance_;  ///< r and 1/|r| of the targets at one node
};

}  // namespace vehd
