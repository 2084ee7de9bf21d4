#include "fem_check/app/point_sources.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <numbers>

#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/potential.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::fem_check {
namespace {

/// φ and ∇φ of either side at points of γ.
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

/// Layers of cells for each cell along an edge of a block, in the shell for the default outer radius.
constexpr double blend_layers = 1.0 / 3.0, shell_layers = 4.0 / 3.0;

meshes::BlockMeshOptions mesh_options(const PointSourceTask& task, double radius) {
  const auto layers = [&](double share) {
    return std::max(1, static_cast<int>(std::lround(share * task.cells_per_edge)));
  };
  const double further = std::log(task.outer_radius) / std::log(PointSourceTask().outer_radius);
  meshes::BlockMeshOptions options;
  options.cells_per_edge = task.cells_per_edge;
  options.blend_layers = layers(blend_layers);
  options.shell_layers = layers(shell_layers * further);
  options.outer_radius = task.outer_radius * radius;
  return options;
}

}  // namespace

PointSourceResult run_point_sources(const PointSourceTask& task) {
  const Hdf5Input file(task.input);
  const Eigen::MatrixXd position = file.matrix("/x");
  const PointSources sources = read_sources(file);

  const std::clock_t start = std::clock();
  const auto elapsed = [&] { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
  const meshes::FrozenShape shape(position);
  const auto mesh =
      std::make_shared<meshes::HexMesh>(meshes::make_block_mesh(shape, mesh_options(task, shape.radius())));
  PointSourceResult result;
  result.seconds_mesh = elapsed();
  const Discretisation discretisation(mesh, task.degree);
  const SurfacePoints points = discretisation.quadrature_points(Refinement::finest().points_per_edge);
  const PotentialSolution solution = solve_potential(discretisation, problem_of(sources));
  const PotentialTraces traces = solution.on_surface(points);
  result.seconds = elapsed();

  result.degree = task.degree;
  result.n_cells = discretisation.n_cells();
  result.n_unknowns = solution.cost().n_unknowns;
  result.outer_radius = mesh->outer_radius();
  result.peak_memory_bytes = solution.cost().peak_memory_bytes;
  const ExactTraces exact = exact_traces(sources, points);
  const Eigen::MatrixXd charge =
      (normal_part(exact.gradient_in, points) - normal_part(exact.gradient_out, points)).transpose();
  const Vectors force = maxwell_traction(exact.gradient_in, points) - maxwell_traction(exact.gradient_out, points);
  result.charge_l2 = relative_l2(points, traces.charge.transpose(), charge);
  result.charge_max = relative_max(traces.charge.transpose(), charge);
  result.force_l2 = relative_l2(points, traces.force, force);
  result.force_max = relative_max(traces.force, force);
  return result;
}

nlohmann::json json_of(const PointSourceResult& result) {
  return {{"degree", result.degree},
          {"cells", result.n_cells},
          {"dofs", result.n_unknowns},
          {"truncation_radius", result.outer_radius},
          {"seconds", result.seconds},
          {"seconds_mesh", result.seconds_mesh},
          {"memory_bytes", result.peak_memory_bytes},
          {"fields",
           {{"q", {{"l2", result.charge_l2}, {"max", result.charge_max}}},
            {"force", {{"l2", result.force_l2}, {"max", result.force_max}}}}}};
}

}  // namespace vehd::fem_check
