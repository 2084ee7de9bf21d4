#pragma once

#include "fem_check/lanes.hpp"
// Lanes first.
#include <deal.II/matrix_free/evaluation_template_factory.h>

/// Shape functions of cells at their Gauss points, for several cells at once. FEEvaluation<3, -1, 0, …> calls these by
/// the degree that it finds when it runs. deal.II's library holds them for one cell at a time, and what its headers
/// would compile for Lanes serves elements, points and refined meshes that are not used here. So they are specialised:
/// fast loops for the degrees of the solvers, loops of any length for what only sets up the geometry.
namespace dealii::internal {

template <>
void FEEvaluationFactory<3, vehd::fem_check::Lanes>::evaluate(unsigned n_components,
                                                              EvaluationFlags::EvaluationFlags flags,
                                                              const vehd::fem_check::Lanes* nodal,
                                                              FEEvaluationData<3, vehd::fem_check::Lanes, false>& cell);

template <>
void FEEvaluationFactory<3, vehd::fem_check::Lanes>::integrate(unsigned n_components,
                                                               EvaluationFlags::EvaluationFlags flags,
                                                               vehd::fem_check::Lanes* nodal,
                                                               FEEvaluationData<3, vehd::fem_check::Lanes, false>& cell,
                                                               bool add);

/// No loop asks for faces.
/// @throws std::logic_error always
template <>
void FEFaceEvaluationFactory<3, vehd::fem_check::Lanes>::evaluate(
    unsigned n_components, EvaluationFlags::EvaluationFlags flags, const vehd::fem_check::Lanes* nodal,
    FEEvaluationData<3, vehd::fem_check::Lanes, true>& face);

/// No mesh is refined here and there.
/// @throws std::logic_error always
template <>
void FEEvaluationHangingNodesFactory<3, double, vehd::fem_check::Lanes>::apply(
    unsigned n_components, unsigned degree, const MatrixFreeFunctions::ShapeInfo<vehd::fem_check::Lanes>& shape,
    bool transpose,
    const std::array<MatrixFreeFunctions::compressed_constraint_kind, vehd::fem_check::Lanes::size()>& constraints,
    vehd::fem_check::Lanes* values);

}  // namespace dealii::internal
