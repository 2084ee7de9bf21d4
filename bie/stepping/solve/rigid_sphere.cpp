#include "bie/stepping/solve/rigid_sphere.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <limits>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "bie/stepping/space/remap.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

Matrix from_centre(const Surface& s) { return s.position.rowwise() - centroid(s).transpose(); }

/// Ω × r in every row.
Matrix rotating(const Vector3& rate, const Matrix& r) {
  Matrix result(r.rows(), 3);
  for (Index i = 0; i < result.rows(); ++i) result.row(i) = rate.cross(Vector3(r.row(i)));
  return result;
}

/// Ω of the part Ω × r of a tangential flow: ∫ r × v dA = (2/3) A R² Ω, and all other parts contribute nothing.
Vector3 rotation_of(const Surface& s, const Matrix& r, const Matrix& velocity, double radius) {
  Vector3 moment = Vector3::Zero();
  for (Index i = 0; i < velocity.rows(); ++i) {
    moment += s.quadrature[i] * Vector3(r.row(i)).cross(Vector3(velocity.row(i)));
  }
  return 1.5 / (s.quadrature.sum() * radius * radius) * moment;
}

/// The rotation that takes the rows of `from` nearest to those of `to`, in the mean square over the surface.
Matrix3 nearest_rotation(const Surface& s, const Matrix& from, const Matrix& to) {
  const Matrix3 moment = to.transpose() * s.quadrature.asDiagonal() * from;
  const Eigen::JacobiSVD<Matrix3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3 signs = Vector3::Ones();
  signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

/// Values of the divergence-free tangential flow.
Matrix flow_within(const Membrane& sphere, const Matrix& velocity) {
  const Surface& s = sphere.surface;
  const SphereVectors flow = sliding_part(sphere.fine, s, velocity);
  return flow.d1.asDiagonal() * s.tangent_1 + flow.d2.asDiagonal() * s.tangent_2;
}

}  // namespace

Matrix rigid_sphere_velocity(const Membrane& sphere, const Matrix& velocity) {
  const Vector3 translation = surface_mean(sphere.surface, sphere.fine.synthesize(velocity));
  return sphere.fine.analyze(flow_within(sphere, velocity).rowwise() + translation.transpose());
}

SphereMotion motion_of_velocity(const Membrane& sphere, const Matrix& velocity, double dt) {
  const Matrix r = from_centre(sphere.surface);
  const Matrix flow = flow_within(sphere, velocity);
  const Vector3 rate = rotation_of(sphere.surface, r, flow, sphere.radius);
  SphereMotion motion;
  motion.translation = dt * surface_mean(sphere.surface, sphere.fine.synthesize(velocity));
  motion.rotation = Eigen::AngleAxisd(rate.norm() * dt, rate.stableNormalized()).toRotationMatrix();
  motion.flow = dt * (flow - rotating(rate, r));
  return motion;
}

SphereMotion motion_of_displacement(const Membrane& sphere, const Matrix& displacement) {
  const Surface& s = sphere.surface;
  const Matrix r = from_centre(s);
  const Matrix moved = sphere.fine.synthesize(displacement);
  SphereMotion motion;
  motion.translation = surface_mean(s, moved);
  const Matrix end = r + (moved.rowwise() - motion.translation.transpose());
  motion.rotation = nearest_rotation(s, r, end);
  motion.flow = end * motion.rotation - r;
  return motion;
}

SurfaceFields moved_sphere(const SurfaceFields& start, const Membrane& sphere, const SphereMotion& motion) {
  const Surface& s = sphere.surface;
  Matrix radial = from_centre(s) + motion.flow;
  const Vector retraction = sphere.radius * radial.rowwise().norm().cwiseInverse();
  radial.array().colwise() *= retraction.array();
  radial *= motion.rotation.transpose();
  const Vector3 centre = centroid(s) + motion.translation;
  SurfaceFields result = start;
  result.position = sphere.fine.analyze(radial.rowwise() + centre.transpose());
  const Vector stretch = area_element(sphere.fine, result.position).cwiseQuotient(s.area_element);
  const Vector stretch_before = 1.0 + sphere.fine.synthesize(start.area_strain).col(0).array();
  result.area_strain = sphere.fine.analyze(stretch_before.cwiseProduct(stretch).array() - 1.0);
  return result;
}

namespace {

/// Points of the parameter sphere, as unit vectors, whose material is at these places after the motion.
Matrix origins(const Membrane& sphere, const SphereMotion& motion, const Matrix& material, const Matrix& places) {
  const SphereGrid& grid = sphere.fine.grid();
  Matrix nodes(grid.n_points(), 3);
  for (Index i = 0; i < nodes.rows(); ++i) nodes.row(i) = direction(point_of(grid, i));
  const Matrix r = from_centre(sphere.surface);
  // Rotation from the parameter sphere to the moved sphere, without the flow within it.
  const Matrix3 turned = motion.rotation * nearest_rotation(sphere.surface, nodes, r);
  Matrix from = r.rowwise().normalized() * turned;
  double before = std::numeric_limits<double>::infinity();
  for (;;) {
    const Matrix missing =
        (places - evaluate_harmonics(material, from, sphere.fine.azimuthal_order())) * turned / sphere.radius;
    double largest = 0.0;
    for (Index i = 0; i < from.rows(); ++i) {
      const Vector3 at = from.row(i);
      const Vector3 step = Vector3(missing.row(i)) - at.dot(Vector3(missing.row(i))) * at;
      largest = std::max(largest, step.norm());
      from.row(i) = along_great_circle(at, step);
    }
    // At the level of rounding the steps no longer shrink.
    if (!(largest < before)) break;
    before = largest;
  }
  if (!(before < thresholds::sphere_variation)) {
    throw ConvergenceError("points of a sphere flow too far within it in one step");
  }
  return from;
}

}  // namespace

SurfaceFields at_translated_nodes(const Matrix& position, const Membrane& sphere, const SphereMotion& motion,
                                  const SurfaceFields& material) {
  const SphereTransform& fine = sphere.fine;
  const Matrix places = sphere.surface.position.rowwise() + motion.translation.transpose();
  const Matrix from = origins(sphere, motion, material.position, places);
  SurfaceFields result = material;
  result.position = position;
  result.position.row(0) += coefficient_of_one * motion.translation.transpose();
  for_each_scalar(
      result, [&](Vector& scalar) { scalar = fine.analyze(evaluate_harmonics(scalar, from, fine.azimuthal_order())); });
  return result;
}

}  // namespace vehd
