#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bie/potentials/node_kernels.hpp"
#include "bie/potentials/rotated_quadrature.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Harmonic coefficients of many columns in the rectangular layout [m][n][column], cosines and sines separate: rows of
/// one m are contiguous (Legendre sums), rows of one n have a constant stride (Wigner blocks). Sines of order 0 are
/// zero; all other entries are uninitialised, since clearing them took longer than many of the sums.
class CoefficientBlock {
 public:
  /// @param highest  m
  CoefficientBlock(int order, int highest, Index cosine_columns, Index sine_columns)
      : width_(order + 1),
        columns_{cosine_columns, sine_columns},
        values_{std::make_unique_for_overwrite<double[]>((highest + 1) * width_ * cosine_columns),
                std::make_unique_for_overwrite<double[]>((highest + 1) * width_ * sine_columns)} {
    std::fill_n(values_[1].get(), order_stride(true), 0.0);
  }

  [[nodiscard]] Index columns(bool sine) const { return columns_[sine]; }
  /// Distance from one order to the next at fixed degree.
  [[nodiscard]] Index order_stride(bool sine) const { return width_ * columns_[sine]; }
  double* row(bool sine, int n, int m) { return values_[sine].get() + (m * width_ + n) * columns_[sine]; }
  const double* row(bool sine, int n, int m) const { return values_[sine].get() + (m * width_ + n) * columns_[sine]; }

 private:
  Index width_;
  std::array<Index, 2> columns_;
  std::array<std::unique_ptr<double[]>, 2> values_;
};

/// Fourier amplitudes along every latitude of the rotated grid, cosines and sines separate: for each latitude the even
/// orders, then the odd ones. Order 0 is set to zero; all other entries are uninitialised.
class AzimuthalAmplitudes {
 public:
  AzimuthalAmplitudes(int n_theta, int order, Index cosine_columns, Index sine_columns)
      : n_orders_(order + 1),
        n_even_(order / 2 + 1),
        columns_{cosine_columns, sine_columns},
        values_{std::make_unique_for_overwrite<double[]>(n_theta * n_orders_ * cosine_columns),
                std::make_unique_for_overwrite<double[]>(n_theta * n_orders_ * sine_columns)} {
    for (const bool sine : {false, true}) {
      for (int i = 0; i < n_theta; ++i) std::fill_n(of_order(sine, i, 0), columns_[sine], 0.0);
    }
  }

  [[nodiscard]] Index columns(bool sine) const { return columns_[sine]; }
  double* of_order(bool sine, int i, int m) {
    return values_[sine].get() + (i * n_orders_ + m / 2 + (m % 2 == 0 ? 0 : n_even_)) * columns_[sine];
  }

 private:
  Index n_orders_, n_even_;
  std::array<Index, 2> columns_;
  std::array<std::unique_ptr<double[]>, 2> values_;
};

/// Columns in the Fourier sums about the target: without a mirror plane each has cosines and sines.
struct FourierColumns {
  std::vector<int> cosine, sine;

  [[nodiscard]] const std::vector<int>& of(bool is_sine) const { return is_sine ? sine : cosine; }
  [[nodiscard]] std::size_t count() const { return cosine.size() + sine.size(); }
};

/// Columns of the components of x.
/// @param mirrored  the target lies in a plane of symmetry y = 0
FourierColumns shape_columns(bool mirrored);
/// Columns of the kernels; `mirrored` as above.
FourierColumns row_columns(const KernelColumns& kernels, bool mirrored);

/// Whether harmonics of even and of odd degree occur.
struct DegreeParities {
  std::array<bool, 2> shape{true, true};  ///< in x
  std::array<bool, 2> rows{true, true};   ///< in the required entries of the rows
};

/// Required entries of the rows and their columns.
struct RowPlaces {
  /// [kernels * active coefficients], order-major: column of each entry, −1 if not required; empty: all, in this order.
  std::vector<Index> columns;
  DegreeParities degrees;
};

/// Data common to all targets of an assembly; all references must outlive the rows.
struct TargetContext {
  const RotatedQuadrature& quadrature;
  const KernelColumns& kernels;
  const Matrix& position;  ///< coefficients of x, [n_coefficients x 3]
  const Vector& phi;       ///< longitudes of the target grid
  int azimuthal_order;
  bool mirrored;  ///< all targets lie in a plane of symmetry y = 0
};

/// Computes on one thread the kernel rows of a chunk of targets, which share the matrix products. Targets of one
/// latitude are adjacent. If all targets lie in a plane of symmetry y = 0, values at azimuths φ and −φ about them are
/// equal up to signs, so that half of the nodes suffice. Latitudes θ and π − θ of the rotated grid share their Legendre
/// sums, four azimuths their Fourier sums. Each latitude is processed from coefficients of the shape to those of the
/// kernels before the next one, so that its nodes stay in cache. If x and all required entries have odd degrees only,
/// x(−s) = −x(s), opposite nodes share all sums.
///
/// Source: Gimbutas and Veerapaneni 2013 for phase shift, rotation and synthesis; here the adjoint of the same chain
/// also converts a kernel row to a row over coefficients
class TargetRows {
 public:
  /// @param places  must outlive the rows
  /// @param chunk   targets at a time, a multiple of kLanes
  TargetRows(const TargetContext& context, const RowPlaces& places, int chunk);

  /// Writes the kernel rows of targets to the columns that the places give.
  /// @param targets  as many as the chunk
  /// @param rows     row Target::row of each target is written
  void run(std::span<const Target> targets, RowMatrix& rows);

 private:
  static constexpr int kShapeKinds = 3;  ///< x, ∂x/∂θ, ∂x/(sin θ ∂φ) in the rotated frame
  /// Cosines of even and odd orders, sines of even and odd orders: common to the azimuths ±φ and π ± φ.
  static constexpr int kParts = 4;

  void load_phases(std::span<const Target> targets);
  void phase_shift();
  void rotate(std::span<const Target> targets);
  void legendre_synthesis(int kind, bool sine);
  /// All nodes of one latitude of the rotated grid: Fourier sums of the shape, kernels, Fourier sums of these.
  void evaluate_latitude(int i);
  void fourier_synthesis(int kind, int i);
  static constexpr std::size_t kMostImages = 4;
  /// Data of all images of a node.
  template <int kWidth>
  using Nodes = std::array<NodeKernels::Node<kWidth>, kMostImages>;
  template <int kWidth>
  using Values = std::array<NodeKernels::Values<kWidth>, kMostImages>;
  template <int kWidth>
  void load_nodes(Index quarter_node, Index first, Nodes<kWidth>& nodes) const;
  template <int kWidth>
  void add_values(Index quarter_node, Index first, const Values<kWidth>& values);
  template <int kWidth>
  void evaluate_node(Index quarter_node, Index first, double weight);
  void fourier_adjoint(int i);
  void legendre_adjoint(bool sine);
  void subtract_pole();
  void rotate_back(std::span<const Target> targets);
  /// A block and the highest order in use at a degree.
  struct Orders {
    CoefficientBlock& block;
    int highest;
  };
  /// Rotates degree n of every target by its own rotation, or by the transpose.
  void rotate_one_by_one(std::span<const Target> targets, int n, const Orders& from, const Orders& to, bool back);
  /// Source of an entry of the rows: its cosine and its sine in rows_, −1 for none, and the pair of phases.
  struct StoredEntry {
    std::int32_t cosine, sine, phases;
  };
  /// Adjacent entries of the rows, at most kLanes.
  struct StoredEntries {
    Index column;
    int count;
    std::array<StoredEntry, kLanes> entries;
  };
  void list_stored_entries();
  void store_rows(std::span<const Target> targets, RowMatrix& rows);

  const RotatedQuadrature& q_;
  const KernelColumns& kernels_;
  const Matrix& position_;
  const RowPlaces& places_;
  Index chunk_;
  int order_;
  int azimuthal_order_;
  bool mirrored_;
  bool inverted_;  ///< degrees are odd: the southern latitudes of the rotated grid follow from the northern ones
  int n_latitudes_;
  std::size_t n_images_;  ///< azimuths that share Fourier sums
  int shape_kinds_;
  Index n_quarter_;
  FourierColumns components_, kernel_columns_;
  CoefficientBlock shape_, rotated_shape_, rows_, rotated_rows_;
  NodeKernels node_kernels_;
  std::vector<AzimuthalAmplitudes> shape_amplitudes_;  ///< per kind
  AzimuthalAmplitudes row_amplitudes_;
  std::array<std::vector<double>, 2> half_;  ///< Legendre sums of even and of odd n + m on one hemisphere
  std::array<std::array<std::vector<double>, kParts>, kShapeKinds> shape_parts_;  ///< [quarter φ x columns]
  std::array<std::vector<double>, kParts> row_parts_;
  Matrix cosines_, sines_;                           ///< of mφ, [longitude x m]
  std::vector<double> cosine_phases_, sine_phases_;  ///< of mφ, [m][target]
  std::vector<double> rotation_entries_;
  std::vector<double> zeros_;  ///< zeros
  std::vector<StoredEntries> stored_;
  std::vector<double> phases_back_;  ///< factors of cosine and of sine, [m, cosines and sines][2][target]
};

}  // namespace vehd
