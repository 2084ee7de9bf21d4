#pragma once

#include <vector>

#include "bie/potentials/kernel_columns.hpp"
#include "bie/potentials/target_images.hpp"

namespace vehd {

/// How the columns of kernel rows are arranged where there is no symmetry, and the operators that are made of them. The
/// columns of a symmetric Stokes single layer stand as in the columns of SymmetricBlocks, so that these are pieces of
/// what the latitudes add up to, and of densities of a high degree nothing is added up for lower ones. Those of other
/// kernels follow one another, coefficients in the order of coefficient_index.
class OperatorColumns {
 public:
  /// @param kernels, active  must outlive this
  OperatorColumns(const KernelColumns& kernels, const ActiveCoefficients& active);

  /// A multiple of kLanes.
  [[nodiscard]] Index width() const { return width_; }
  /// Column of each entry of [kernels * active coefficients], order-major.
  [[nodiscard]] const std::vector<Index>& columns() const { return columns_; }
  /// What LongitudeSums finds at all latitudes.
  struct Amplitudes {
    const double* values;
    const std::vector<int>& orders;
  };
  /// Sums of one mode over latitudes, which become columns of the operators. Threads may share the modes.
  /// @param analysis  Gauss weight times harmonics of |m|, [latitudes x degrees]
  /// @param first     nothing has been added before
  void add(const Amplitudes& amplitudes, Index mode, const Matrix& analysis, bool first);
  /// Once everything is added.
  [[nodiscard]] LayerOperators take(const LayerSelection& selection, Index n_coefficients);

 private:
  /// A row of sums: what one coefficient finds, from one column on.
  void put(Index out, Index first_column, Index count, const double* from, bool first);

  const KernelColumns& kernels_;
  const ActiveCoefficients& active_;
  std::vector<int> degrees_;  ///< of the active coefficients
  Index width_ = 0;
  Index symmetric_width_ = 0;         ///< of the columns of the Stokes single layer, which come first
  std::vector<Index> first_columns_;  ///< of each kernel; of the Stokes single layer unused
  std::vector<Index> columns_;
  SymmetricBlocks symmetric_;
  std::vector<Matrix> operators_;  ///< per kernel, transposed
};

}  // namespace vehd
