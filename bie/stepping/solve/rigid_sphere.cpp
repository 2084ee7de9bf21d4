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

/// Cartesian components of tangent vectors, [n_points x 3].
Matrix cartesian(const Surface& s, const SphereVectors& v) {
  return v.d1.asDiagonal() * s.tangent_1 + v.d2.asDiagonal() * s.tangent_2;
}

/// Values of the divergence-free tangential flow.
Matrix flow_within(const Membrane& sphere, const Matrix& velocity) {
  return cartesian(sphere.surface, sliding_part(sphere.fine, sphere.surface, velocity));
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
  const Vector stretch_before = 1.0 + sphere.fine.synthesize(start.area_strain).col(0).array();
  Matrix radial = from_centre(s) + motion.flow;
  Vector strain;
  double before = std::numeric_limits<double>::infinity();
  for (;;) {
    const Vector retraction = sphere.radius * radial.rowwise().norm().cwiseInverse();
    radial.array().colwise() *= retraction.array();
    const Surface moved = make_surface(sphere.fine, sphere.fine.analyze(radial));
    strain = stretch_before.cwiseProduct(moved.area_element).cwiseQuotient(s.area_element).array() - 1.0;
    const double largest = strain.cwiseAbs().maxCoeff();
    // At the level of rounding or of truncation the strain no longer shrinks.
    if (!(largest < 0.5 * before)) break;
    before = largest;
    const Vector excess = strain.cwiseQuotient(Vector(1.0 + strain.array())).cwiseProduct(moved.area_element);
    radial -= cartesian(moved, displacement_of_divergence(sphere.fine, moved, excess));
  }
  SurfaceFields result = start;
  radial *= motion.rotation.transpose();
  result.position = sphere.fine.analyze(radial.rowwise() + (centroid(s) + motion.translation).transpose());
  result.area_strain = sphere.fine.analyze(strain);
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
