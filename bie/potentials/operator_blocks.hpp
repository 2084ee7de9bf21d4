#pragma once

#include <vector>

#include "bie/potentials/kernel_columns.hpp"
#include "bie/potentials/target_rows.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/sphere/symmetry.hpp"

namespace vehd {

/// Columns of some kernels between two sets of coefficients, and their places in the matrices of the operators.
struct OperatorBlock {
  /// Place of one kernel's columns.
  struct Destination {
    int kernel;
    std::size_t matrix;         ///< in SymmetricLayout
    Index first_in, first_out;  ///< row and column of the block in the transposed matrix
  };
  std::vector<Index> in, out;  ///< coefficient_index, ascending
  std::vector<Destination> destinations;
  std::vector<int> kernels;  ///< of the destinations, each once
  Index first_column = 0;    ///< in the rows

  [[nodiscard]] Index n_in() const { return static_cast<Index>(in.size()); }
  [[nodiscard]] Index n_columns() const { return static_cast<Index>(kernels.size()) * n_in(); }
  /// Width in the rows, a multiple of kLanes.
  [[nodiscard]] Index width() const { return filled_up(n_columns()); }
};

/// Blocks of the operators on symmetric fields. Blocks between the same sets of coefficients are merged, so that a
/// kernel is carried along once for two components that have the same coefficients.
struct SymmetricLayout {
  std::vector<OperatorBlock> blocks;        ///< side by side in the rows
  std::vector<Index> sizes;                 ///< rows and columns of each matrix
  std::vector<Index> entries;               ///< entries of the Stokes layers, SymmetrySubspace::vectors
  std::vector<std::vector<Index>> classes;  ///< nonempty classes of the Laplace layers
  /// Matrices of a layer are consecutive: one for a Stokes layer, one per class for a Laplace layer.
  std::vector<std::size_t> first_matrix;  ///< per kernel

  [[nodiscard]] Index width() const { return blocks.back().first_column + blocks.back().width(); }
};

/// @param azimuthal_order  highest |m| that is included
SymmetricLayout symmetric_layout(const KernelColumns& kernels, const SymmetrySubspace& subspace, int azimuthal_order);

/// Which parities of degree occur in x, and in the row entries that operators on symmetric fields need. Under the
/// inversion x → −x, x and velocities have odd degrees only.
/// @param turned  whole rows are needed, for rotation to other targets
DegreeParities degree_parities(const KernelColumns& kernels, const SymmetrySubspace& subspace, bool turned);

/// Order m of a coefficient_index.
int order_of_index(Index index);

}  // namespace vehd
