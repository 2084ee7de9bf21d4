#pragma once

#include <vector>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/surface_series.hpp"
#include "fem_check/per_vesicle.hpp"

/// Fields and parameters of all vesicles of an input, in the form that the solvers require.
namespace vehd::fem_check {

/// A field of all vesicles from its coefficients.
template <typename Field>
SurfaceSeries series_of(const std::vector<CheckInput>& inputs, const Field& field) {
  std::vector<Eigen::MatrixXd> of_vesicles;
  for (const CheckInput& input : inputs) of_vesicles.push_back(field(input));
  return SurfaceSeries(of_vesicles);
}

/// A physical parameter of all vesicles.
inline PerVesicle<double> number_of(const std::vector<CheckInput>& inputs, double Physics::*number) {
  std::vector<double> of_vesicles;
  for (const CheckInput& input : inputs) of_vesicles.push_back(input.physics.*number);
  return of_vesicles;
}

}  // namespace vehd::fem_check
