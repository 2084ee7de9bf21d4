#include "fem_check/app/point_sources.hpp"

#include <cmath>
#include <numbers>

#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/potential.hpp"

namespace vehd::fem_check {
namespace {

/// φ and ∇φ on both sides at points of γ.
struct ExactTraces {
  Vector potential_in, potential_out;
  Vectors gradient_in, gradient_out;
};

ExactTraces exact_traces(const PointSources& sources, const SurfacePoints& points) {
  const Eigen::Index n = points.size();
  ExactTraces exact{Vector::Zero(n), Vector::Zero(n), Vectors::Zero(3, n), Vectors::Zero(3, n)};
  for (Eigen::Index source = 0; source < sources.strength.size(); ++source) {
    const bool inside = sources.inside[static_cast<std::size_t>(source)];
    Vector& potential = inside ? exact.potential_out : exact.potential_in;
    Vectors& gradient = inside ? exact.gradient_out : exact.gradient_in;
    const double scale = sources.strength[source] / (4.0 * std::numbers::pi);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vector3 r = points.position.col(i) - sources.position.col(source);
      potential[i] += scale / r.norm();
      gradient.col(i) -= scale / std::pow(r.norm(), 3) * r;
    }
  }
  return exact;
}

Vector normal_part(const Vectors& gradient, const SurfacePoints& points) {
  return gradient.cwiseProduct(points.normal).colwise().sum().transpose();
}

Vectors maxwell_traction(const Vectors& gradient, const SurfacePoints& points) {
  const Vector flux = normal_part(gradient, points);
  const Vector pressure = -0.5 * gradient.colwise().squaredNorm().transpose();
  return gradient * flux.asDiagonal() + points.normal * pressure.asDiagonal();
}

PotentialProblem problem_of(const PointSources& sources) {
  PotentialProblem problem;
  problem.conductivity_in = sources.conductivity_in;
  problem.conductivity_out = sources.conductivity_out;
  problem.tolerance = Refinement::finest().potential_tolerance;
  problem.membrane = PrescribedJump{[&sources](const SurfacePoints& points) {
    const ExactTraces exact = exact_traces(sources, points);
    return Vector(exact.potential_in - exact.potential_out);
  }};
  problem.current_jump = [&sources](const SurfacePoints& points) {
    const ExactTraces exact = exact_traces(sources, points);
    return Vector(sources.conductivity_in * normal_part(exact.gradient_in, points) -
                  sources.conductivity_out * normal_part(exact.gradient_out, points));
  };
  return problem;
}

PointSources read_sources(const Hdf5Input& file) {
  PointSources sources;
  const Eigen::MatrixXd position = file.matrix("/sources/position"), inside = file.matrix("/sources/inside");
  sources.strength = file.matrix("/sources/strength").col(0);
  if (position.cols() != 3 || position.rows() != sources.strength.size() || inside.rows() != position.rows()) {
    file.refuse("positions, strengths and sides of the sources differ in number");
  }
  sources.position = position.transpose();
  for (Eigen::Index i = 0; i < inside.rows(); ++i) sources.inside.push_back(inside(i, 0) > 0.0);
  sources.conductivity_in = file.number("/physics", "conductivity_in");
  sources.conductivity_out = file.number("/physics", "conductivity_out");
  return sources;
}

}  // namespace

PointSourceResult run_point_sources(const LevelTask& task) {
  const Hdf5Input file(task.input);
  const Eigen::MatrixXd position = file.matrix("/x");
  const PointSources sources = read_sources(file);

  const LevelSpace space(meshes::FrozenShape(position), task);
  const Discretisation& discretisation = space.discretisation();
  const SurfacePoints points = discretisation.quadrature_points(Refinement::finest().points_per_edge);
  const PotentialSolution solution = solve_potential(discretisation, problem_of(sources));
  const PotentialTraces traces = solution.on_surface(points);
  PointSourceResult result{space.cost_so_far(), {}, {}};
  result.cost.n_unknowns = solution.cost().n_unknowns;
  result.cost.peak_memory_bytes = solution.cost().peak_memory_bytes;

  const ExactTraces exact = exact_traces(sources, points);
  const Eigen::MatrixXd found = traces.charge.transpose();
  const Eigen::MatrixXd charge =
      (normal_part(exact.gradient_in, points) - normal_part(exact.gradient_out, points)).transpose();
  const Vectors force = maxwell_traction(exact.gradient_in, points) - maxwell_traction(exact.gradient_out, points);
  result.charge = {relative_l2(points, found, charge), relative_max(found, charge)};
  result.force = {relative_l2(points, traces.force, force), relative_max(traces.force, force)};
  return result;
}

nlohmann::json json_of(const PointSourceResult& result) {
  nlohmann::json json = json_of(result.cost);
  json["fields"] = {{"q", json_of(result.charge)}, {"force", json_of(result.force)}};
  return json;
}

}  // namespace vehd::fem_check
