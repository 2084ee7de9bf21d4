#include "fem_check/cell_kernels.hpp"

#include <deal.II/matrix_free/evaluation_kernels.h>

#include <stdexcept>

namespace dealii::internal {

namespace {

using vehd::fem_check::Lanes;
using CellData = FEEvaluationData<3, Lanes, false>;

/// Highest degrees with loops of their own: of the potential and the velocity, and of the pressure.
constexpr int highest_scalar = 9;
constexpr int highest_pressure = 8;

/// Calls work() with the loops compiled for the degree and the points of a cell; false where there are none. Elements
/// of degree k have k + 2 Gauss points per direction, k + 1 where they only precondition, those of the pressure, one
/// degree below its velocity, k + 3.
template <int degree = 1, typename Work>
bool with_fast_loops(const CellData& cell, const Work& work) {
  const auto& shape = cell.get_shape_info().data.front();
  if (cell.get_shape_info().element_type > MatrixFreeFunctions::tensor_symmetric) return false;
  if constexpr (degree <= highest_scalar) {
    if (shape.fe_degree != degree) return with_fast_loops<degree + 1>(cell, work);
    if (shape.n_q_points_1d == degree + 1) {
      work(FEEvaluationImplTransformToCollocation<3, degree, degree + 1, Lanes>());
      return true;
    }
    if (shape.n_q_points_1d == degree + 2) {
      work(FEEvaluationImplTransformToCollocation<3, degree, degree + 2, Lanes>());
      return true;
    }
    if constexpr (degree <= highest_pressure) {
      if (shape.n_q_points_1d == degree + 3) {
        work(FEEvaluationImplTransformToCollocation<3, degree, degree + 3, Lanes>());
        return true;
      }
    }
  }
  return false;
}

using AnyLoops = FEEvaluationImpl<MatrixFreeFunctions::tensor_general, 3, -1, 0, Lanes>;

}  // namespace

template <>
void FEEvaluationFactory<3, Lanes>::evaluate(unsigned n_components, EvaluationFlags::EvaluationFlags flags,
                                             const Lanes* nodal, CellData& cell) {
  const auto run = [&](auto loops) { loops.evaluate(n_components, flags, nodal, cell); };
  if (!with_fast_loops(cell, run)) run(AnyLoops());
}

template <>
void FEEvaluationFactory<3, Lanes>::integrate(unsigned n_components, EvaluationFlags::EvaluationFlags flags,
                                              Lanes* nodal, CellData& cell, bool add) {
  const auto run = [&](auto loops) { loops.integrate(n_components, flags, nodal, cell, add); };
  if (!with_fast_loops(cell, run)) run(AnyLoops());
}

template <>
void FEFaceEvaluationFactory<3, Lanes>::evaluate(unsigned /*n_components*/, EvaluationFlags::EvaluationFlags /*flags*/,
                                                 const Lanes* /*nodal*/, FEEvaluationData<3, Lanes, true>& /*face*/) {
  throw std::logic_error("loops over faces are not compiled");
}

template <>
void FEEvaluationHangingNodesFactory<3, double, Lanes>::apply(
    unsigned /*n_components*/, unsigned /*degree*/, const MatrixFreeFunctions::ShapeInfo<Lanes>& /*shape*/,
    bool /*transpose*/,
    const std::array<MatrixFreeFunctions::compressed_constraint_kind, Lanes::size()>& /*constraints*/,
    Lanes* /*values*/) {
  throw std::logic_error("loops over locally refined cells are not compiled");
}

}  // namespace dealii::internal
