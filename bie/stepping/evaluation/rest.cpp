#include "bie/stepping/evaluation/rest.hpp"

#include <algorithm>

namespace vehd {

namespace {

Vector3 centroid_velocity_of(const VesicleDiagnostics& d) {
  return {d.centroid_velocity_x, d.centroid_velocity_y, d.centroid_velocity_z};
}

/// The largest relative rate of V_m, charges and pores.
double rate_on_membrane(const Model& model, const VesicleState& vesicle, const VesicleSolution& solution,
                        const VesicleDiagnostics& d) {
  const SphereTransform& fine = solution.membrane->fine;
  const Surface& s = solution.membrane->surface;
  const Unknowns& rate = solution.rate;
  Matrix relative = Matrix::Zero(s.n_points(), 3);
  if (rate.position.size() > 0) {
    relative = fine.synthesize(rate.position).rowwise() - centroid_velocity_of(d).transpose();
  }
  const auto relative_rate = [&](const Vector& field, const Vector& of_material, double scale) {
    if (of_material.size() == 0) return 0.0;
    const Matrix gradient = surface_gradient(s, fine.synthesize_gradient(field));
    const Vector there = Vector(fine.synthesize(of_material)) - relative.cwiseProduct(gradient).rowwise().sum();
    const double size = std::max(scale, fine.synthesize(field).cwiseAbs().maxCoeff());
    const double most = there.cwiseAbs().maxCoeff();
    return most == 0.0 ? 0.0 : most / size;
  };
  const double imposed = model.electric ? model.electric->field.norm() * solution.membrane->radius : 0.0;
  return std::max({relative_rate(vesicle.transmembrane_potential, rate.transmembrane_potential, imposed),
                   relative_rate(vesicle.free_charge, rate.free_charge, imposed),
                   relative_rate(vesicle.poration, rate.poration, 0.0)});
}

}  // namespace

double largest_rate(const Model& model, const State& state, const Evaluation& evaluation) {
  double most = 0.0;
  const Vector3 first = centroid_velocity_of(evaluation.diagnostics.vesicles.front());
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleDiagnostics& d = evaluation.diagnostics.vesicles[a];
    const VesicleSolution& solution = evaluation.vesicles[a];
    double approach = (centroid_velocity_of(d) - first).norm();
    if (model.wall) approach = std::max(approach, std::abs(model.wall->normal.dot(centroid_velocity_of(d))));
    most = std::max({most, d.shape_rate, approach / solution.membrane->radius,
                     rate_on_membrane(model, state.vesicles[a], solution, d)});
  }
  return most;
}

}  // namespace vehd
