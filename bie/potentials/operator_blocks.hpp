#pragma once

#include <vector>

#include "bie/potentials/kernel_columns.hpp"
#include "bie/potentials/target_rows.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/sphere/symmetry.hpp"

namespace vehd {

/// Columns of some kernels between two sets of coefficients, and where they belong in the matrices of the operators.
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
  /// In the rows, a multiple of kLanes.
  [[nodiscard]] Index width() const { return filled_up(n_columns()); }
};

/// Blocks of the operators on symmetric fields. Blocks between the same sets of coefficients are one, so that a
/// kernel of two components is not carried along twice where these have the same coefficients.
struct SymmetricLayout {
  std::vector<OperatorBlock> blocks;        ///< side by side in the rows
  std::vector<Index> sizes;                 ///< rows and columns of each matrix
  std::vector<Index> entries;               ///< SymmetrySubspace::vectors, those of the Stokes layers
  std::vector<std::vector<Index>> classes;  ///< those of the Laplace layers that are not empty
  /// Matrices of a layer follow one another: one of a Stokes layer, one per class of a Laplace layer.
  std::vector<std::size_t> first_matrix;  ///< per kernel

  [[nodiscard]] Index width() const { return blocks.back().first_column + blocks.back().width(); }
};

/// @param azimuthal_order  highest |m| that takes part
SymmetricLayout symmetric_layout(const KernelColumns& kernels, const SymmetrySubspace& subspace, int azimuthal_order);

/// Are there harmonics of even, of odd degree in x, and in the entries of the rows that operators on symmetric fields
/// need? Under the inversion x → −x only odd ones are left of x and of velocities.
/// @param turned  rows are taken to those of other targets as a whole
DegreeParities degree_parities(const KernelColumns& kernels, const SymmetrySubspace& subspace, bool turned);

/// The m of a coefficient_index.
int order_of_index(Index index);

}  // namespace vehd
