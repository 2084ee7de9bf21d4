#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bie/potentials/rotated_quadrature.hpp"
#include "bie/sphere/symmetry.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/instruments.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Six blocks xx, xy, xz, yy, yz, zz of a symmetric operator on vector fields. Each block is symmetric in its
/// coefficients and stores every pair once, which halves the memory that an application reads.
///
/// The single layer is symmetric; its quadrature is so only up to aliasing of high degrees. The rotated rule resolves
/// the product of a kernel with a smooth density, and the targets resolve the result. Of two transposed entries the
/// potential of higher degree of a density of lower degree is therefore used; the other one would require rule and
/// targets to resolve a density of the higher degree. Between coefficients of one degree the mean of both is used, so
/// that the choice commutes with rotations of the sphere.
/// Accuracy: entries that matter for smooth densities lose no accuracy, the translating prolate keeps 4e-12 at p = 16
/// (tests/potentials/translating_prolate_test.cpp); symmetric to rounding (tests/potentials/stokes_identities_test.cpp)
class SymmetricBlocks {
 public:
  /// Number of coefficients stored side by side in a column.
  static constexpr Index kGroup = 8;
  static constexpr int kBlocks = 6;

  SymmetricBlocks() = default;
  /// Allocates the columns, all of which must be filled.
  /// @param degrees  of the coefficients, ascending
  explicit SymmetricBlocks(std::vector<int> degrees);

  [[nodiscard]] Index size() const { return static_cast<Index>(degrees_.size()); }
  /// Column for coefficient `out` of the potentials of densities of its degree and lower ones, filled by the assembly:
  /// [groups][blocks][kGroup]; symmetrize() clears the padding of the last group.
  [[nodiscard]] double* column(Index out) { return values_.data() + starts_[static_cast<std::size_t>(out)]; }
  /// Number of density coefficients in the column of `out`: all up to its degree.
  [[nodiscard]] Index n_in(Index out) const { return ends_[static_cast<std::size_t>(out)]; }
  /// Position of a block's entry in a column.
  [[nodiscard]] static Index place(int block, Index in) {
    return (in / kGroup * kBlocks + block) * kGroup + in % kGroup;
  }
  /// Number of values in a column of n_in coefficients, with whole groups.
  [[nodiscard]] static Index filled(Index n_in) { return (n_in + kGroup - 1) / kGroup * kGroup * kBlocks; }
  /// First coefficient of the group to which a position belongs.
  [[nodiscard]] static Index first_in(Index place) { return place / (kBlocks * kGroup) * kGroup; }
  /// Must be called once after all columns are filled and before the first application.
  void symmetrize();

  /// Entry of a block, for i and j in either order.
  [[nodiscard]] double at(int block, Index i, Index j) const;
  /// The potential of a density.
  /// @param density  [size x 3]
  /// @return         [size x 3]
  [[nodiscard]] Matrix apply(const Matrix& density) const;

 private:
  /// Adds the contribution of columns [first, end).
  void apply_columns(Index first, Index end, const RowMatrix& density, RowMatrix& sums) const;

  std::vector<int> degrees_;
  std::vector<Index> ends_;  ///< for each coefficient, the first one of the next degree
  std::vector<Index> starts_;
  Vector values_;  ///< columns one after another; entries of the diagonal are halved
};

/// Scalar layer operator from coefficients to coefficients of degree p: one matrix for each class of coefficients that
/// it maps to itself, no coupling between classes. Stored transposed, so that its application reads contiguous columns.
/// Coefficients outside all classes are not read, and are zero in the result.
class ScalarOperator {
 public:
  /// The operator on one class of coefficients.
  struct Part {
    std::vector<Index> indices;  ///< coefficient_index of each row, ascending
    Matrix transposed;
  };

  ScalarOperator() = default;
  /// @param n_coefficients  of a density
  ScalarOperator(Index n_coefficients, std::vector<Part> parts)
      : n_coefficients_(n_coefficients), parts_(std::move(parts)) {}

  [[nodiscard]] bool empty() const { return parts_.empty(); }
  /// The potential of every column of the density.
  /// @param density  [n_coefficients x n_fields], f or J f, see LayerOperators
  /// @return         [n_coefficients x n_fields]
  /// @throws ShapeError if the density has another number of coefficients
  [[nodiscard]] Matrix apply(const Matrix& density) const;

 private:
  Index n_coefficients_ = 0;
  std::vector<Part> parts_;
};

/// Stokes layer from [n_coefficients x 3] to [n_coefficients x 3]. The kernels of both layers are symmetric in their
/// two components; the operator of the single layer is symmetric as a whole. On symmetric fields the operator is one
/// matrix over the entries that can be nonzero.
class StokesOperator {
 public:
  StokesOperator() = default;
  /// @param symmetric  after symmetrize()
  /// @param active     as below
  explicit StokesOperator(SymmetricBlocks symmetric, std::vector<Index> active = {})
      : symmetric_(std::move(symmetric)), active_(std::move(active)) {}
  /// @param transposed  blocks xx, xy, xz, yy, yz, zz
  /// @param active      coefficient_index of each row, or empty if all coefficients are present
  explicit StokesOperator(std::array<Matrix, 6> transposed, std::vector<Index> active = {})
      : transposed_(std::move(transposed)), active_(std::move(active)) {}
  /// The operator on fields that are nonzero only at some entries; all others are not read, and are zero in the result.
  /// @param n_coefficients  of each component
  /// @param entries         of the column-major [n_coefficients x 3], ascending
  /// @param transposed      [entries x entries]
  StokesOperator(Index n_coefficients, std::vector<Index> entries, Matrix transposed)
      : n_coefficients_(n_coefficients), entries_(std::move(entries)), on_entries_(std::move(transposed)) {}

  [[nodiscard]] bool empty() const { return n_rows() == 0 && on_entries_.size() == 0; }
  /// @param density  J f of the force per area for the single layer, the velocity for the double layer,
  ///     [n_coefficients x 3]
  /// @return         velocity, [n_coefficients x 3]
  /// @throws ShapeError if the density does not have three columns, or has fewer coefficients than the operator
  [[nodiscard]] Matrix apply(const Matrix& density) const;
  /// The operator between some entries of the column-major [n_coefficients x 3], row: velocity, column: density.
  /// @param n_coefficients  of each component
  /// @param entries         ascending; entries beyond those of the operator give zeros
  /// @return                [entries x entries]
  [[nodiscard]] Matrix between(Index n_coefficients, const std::vector<Index>& entries) const;

 private:
  /// Number of coefficients per component if there are blocks.
  [[nodiscard]] Index n_rows() const { return std::max(symmetric_.size(), transposed_[0].rows()); }
  [[nodiscard]] Matrix apply_blocks(const Matrix& density) const;

  SymmetricBlocks symmetric_;
  std::array<Matrix, 6> transposed_;
  std::vector<Index> active_;
  Index n_coefficients_ = 0;
  std::vector<Index> entries_;
  Matrix on_entries_;
};

/// Operators that an assembly makes; those that are false cost nothing.
struct LayerSelection {
  bool laplace_single = false;
  bool laplace_double = false;
  bool laplace_adjoint = false;
  bool stokes_single = false;
  bool stokes_double = false;
  bool laplace_hypersingular = false;
  bool plain = false;  ///< all densities and values are f, not J f
};

/// Densities of S, S′ and the Stokes single layer enter weighted: as coefficients of J f, J = W/sin θ (the area element
/// on the unit sphere), so that ∫ K f dA = ∫ K (J f) dω. The weighted density of a tangential derivative or of a force
/// is smoother than the density itself, truncation to degree p keeps its integral exactly, and the kernel rows need no
/// area element. The densities of D and of the Stokes double layer enter plain, because J n(y) belongs to their
/// kernels. If a selection is `plain`, J(y) is part of the other kernels as well, so that J f is not truncated to
/// degree p.
///
/// Layer operators on the membrane; in plain ones J f is replaced by f. D, S′ and the Stokes double layer are principal
/// values: the caller adds the side-dependent ±½ density of Eq. (11), so that the side is written where it is chosen.
/// Values are computed at the nodes of the grid of order p and projected onto degree p.
struct LayerOperators {
  ScalarOperator laplace_single;   ///< J f ↦ S[f], Eq. (8)
  ScalarOperator laplace_double;   ///< f ↦ D[f], Eq. (8), principal value
  ScalarOperator laplace_adjoint;  ///< J f ↦ J S′[f], Eq. (10), principal value; J n(x) is smooth where n(x) is not
  StokesOperator stokes_single;    ///< J f ↦ Stokes single layer, Eq. (6) at μ = 1
  StokesOperator stokes_double;    ///< v ↦ Stokes double layer, stokes_double_kernel, principal value
  /// f ↦ J D′[f] = J ∫ ∂²G/∂n(x)∂n(y) (f(y) − f(x)) dA, Eq. (10): its quadrature truncates no product of f to degree p.
  ScalarOperator laplace_hypersingular;
};

/// Kernel evaluations of each selected operator in one assembly: independent targets times the nodes of each, of which
/// half suffice if the targets lie in a mirror plane.
std::uint64_t evaluations_per_assembly(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                       const std::vector<Reflection>& reflections, int fold = 1);

/// Records the kernel evaluations of one assembly.
void count_evaluations(const LayerSelection& selection, std::uint64_t evaluations, Instruments& instruments);

/// Assembles the selected operators for one surface at cost O(p^5): each target's kernel row on the rotated quadrature
/// is converted to coefficients by the adjoint of "phase shift, Wigner rotation, synthesis", and the rows of all
/// targets are analysed on the order-p grid.
/// @param transform    between degree p and the grid of order p, whose nodes are the targets; coefficients beyond its
///                     azimuthal order are ignored
/// @param reflections  maps g with x(g s) = g x(s), closed under composition: targets that are images of one another
///                     share one row
/// @param fold         rotations by 2π/fold about z are such maps as well; it divides the number of longitudes
/// @param position     coefficients of x, [n_coefficients x 3]
/// @param instruments  receives the number of kernel evaluations of every operator
/// Accuracy: spectral. Eigenvalues of the sphere to 1e-11 for p from 8 to 64
/// (tests/potentials/sphere_spectrum_test.cpp, tests/potentials/stokes_sphere_test.cpp); Green's representation on
/// shape (33) at p = 32 to 1e-6 (tests/potentials/laplace_identities_test.cpp)
/// Source: paper Eqs. (6), (8), (10), (23); rotations of the grid after Gimbutas and Veerapaneni 2013
LayerOperators assemble_layer_operators(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                        const Matrix& position, const LayerSelection& selection,
                                        Instruments& instruments, const std::vector<Reflection>& reflections = {},
                                        int fold = 1);

/// The operators of assemble_layer_operators for symmetric surfaces and fields: Stokes layers between the entries that
/// can be nonzero in symmetric fields, Laplace layers in the classes of SymmetrySubspace. Of targets that are images of
/// one another only one is evaluated, and products and matrices shrink with the order of the group.
/// @param subspace  of the surface and of all densities of Stokes layers
/// @param fold      rotations by 2π/fold about z map the surface and the set of longitudes to themselves
/// Accuracy: rounding; the full operators on symmetric fields to 1e-12 (tests/potentials/symmetric_operators_test.cpp)
LayerOperators assemble_symmetric_operators(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                            const Matrix& position, const LayerSelection& selection,
                                            Instruments& instruments, const SymmetrySubspace& subspace, int fold);

}  // namespace vehd
