#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "fem_check/flow.hpp"
#include "fem_check/potential.hpp"
#include "meshes/volume_mesh.hpp"
#include "tests/meshes/shapes.hpp"

/// Meshes and exact solutions of the finite-element tests.
namespace vehd::fem_check::testing {

namespace meshes = vehd::meshes;
namespace shapes = vehd::meshes::testing;

/// Refinement of a block mesh by one number: cells per edge, with layers in proportion.
struct OneMesh {
  int cells_per_edge = 2;
  int blend_layers = 1;
  int shell_layers = 4;
  int degree = 3;
  double outer_radius = 8.0;
};

inline Discretisation discretise(const meshes::FrozenShape& shape, const OneMesh& level, Ranks ranks = Ranks::all) {
  meshes::BlockMeshOptions options;
  options.cells_per_edge = level.cells_per_edge;
  options.blend_layers = level.blend_layers;
  options.shell_layers = level.shell_layers;
  options.outer_radius = level.outer_radius;
  return {std::make_shared<meshes::HexMesh>(meshes::make_block_mesh(shape, options)), level.degree, ranks};
}

/// A mesh of which only the membrane is used.
inline meshes::HexMesh membrane_mesh(const meshes::FrozenShape& shape, int cells_per_edge) {
  meshes::BlockMeshOptions options;
  options.cells_per_edge = cells_per_edge;
  options.blend_layers = 1;
  options.shell_layers = 2;
  return meshes::make_block_mesh(shape, options);
}

inline meshes::FrozenShape unit_sphere() {
  return meshes::FrozenShape(meshes::testing::project(1, [](const meshes::Point& r) { return r; }));
}

constexpr double kDepolarisation = 0.17356399;  ///< for the 2:1 prolate along its axis

/// 1/(4π|x − y|) and its gradient in x.
struct PointSource {
  Vector3 position;
  double strength = 1.0;

  [[nodiscard]] double value(const Vector3& x) const {
    return strength / (4.0 * std::numbers::pi * (x - position).norm());
  }
  [[nodiscard]] Vector3 gradient(const Vector3& x) const {
    const Vector3 r = x - position;
    return -strength / (4.0 * std::numbers::pi * std::pow(r.norm(), 3)) * r;
  }
};

/// One scalar per point from a function of position and normal.
template <typename Function>
Vector sampled(const SurfacePoints& points, const Function& f) {
  Vector result(points.size());
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    result[i] = f(Vector3(points.position.col(i)), Vector3(points.normal.col(i)));
  }
  return result;
}

/// One vector per point from a function of position and normal.
template <typename Function>
Vectors sampled_vectors(const SurfacePoints& points, const Function& f) {
  Vectors result(3, points.size());
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    result.col(i) = f(Vector3(points.position.col(i)), Vector3(points.normal.col(i)));
  }
  return result;
}

template <typename Function>
VectorOnSurface vectors_on_surface(const Function& f) {
  return [f](const SurfacePoints& points) { return sampled_vectors(points, f); };
}

template <typename Function>
ScalarOnSurface on_surface(const Function& f) {
  return [f](const SurfacePoints& points) { return sampled(points, f); };
}

/// φ of a source outside γ on the inside and of a source inside γ on the outside; σ_i = 1, σ_e = 2.
struct TwoSources {
  PointSource inner_field;  ///< source outside
  PointSource outer_field;  ///< source inside
  double conductivity_in = 1.0;
  double conductivity_out = 2.0;

  [[nodiscard]] double jump(const Vector3& x) const { return inner_field.value(x) - outer_field.value(x); }
  [[nodiscard]] double flux_in(const Vector3& x, const Vector3& n) const { return n.dot(inner_field.gradient(x)); }
  [[nodiscard]] double flux_out(const Vector3& x, const Vector3& n) const { return n.dot(outer_field.gradient(x)); }
  [[nodiscard]] double charge(const Vector3& x, const Vector3& n) const { return flux_in(x, n) - flux_out(x, n); }
  [[nodiscard]] Vector3 force(const Vector3& x, const Vector3& n) const {
    const auto stress = [&](const Vector3& field) {
      return Vector3(field.dot(n) * field - 0.5 * field.squaredNorm() * n);
    };
    return stress(inner_field.gradient(x)) - stress(outer_field.gradient(x));
  }
  /// The problem without its membrane law.
  [[nodiscard]] PotentialProblem problem() const {
    PotentialProblem result;
    result.conductivity_in = conductivity_in;
    result.conductivity_out = conductivity_out;
    result.membrane = PrescribedJump{on_surface([*this](const Vector3& x, const Vector3&) { return jump(x); })};
    result.current_jump = on_surface([*this](const Vector3& x, const Vector3& n) {
      return conductivity_in * flux_in(x, n) - conductivity_out * flux_out(x, n);
    });
    result.outer.kind = OuterCondition::Kind::dirichlet;
    result.outer.value = [source = outer_field](const Vector3& x) { return source.value(x); };
    return result;
  }
};

inline TwoSources sources_of_shape_33() { return {{{1.5, -1.2, 2.5}, 10.0}, {{0.1, 0.2, 0.05}, 1.0}}; }
inline TwoSources sources_of_disc() { return {{{1.5, -1.2, 2.5}, 10.0}, {{0.55, 0.2, 0.02}, 1.0}}; }

/// Slope of log error against log size between two levels whose sizes differ by `ratio`.
inline double observed_order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

}  // namespace vehd::fem_check::testing
