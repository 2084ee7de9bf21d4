#include "bie/stepping/evaluation/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "bie/physics/effects/bending.hpp"
#include "bie/sphere/axis_crossing.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/maximum.hpp"
#include "bie/sphere/principal_axes.hpp"
#include "bie/stepping/evaluation/operator_checks.hpp"
#include "bie/stepping/evaluation/poration_load.hpp"
#include "bie/stepping/evaluation/volume_moments.hpp"
#include "bie/stepping/evaluation/wrinkling.hpp"

namespace vehd {

namespace {

/// Errors of the layers up to this many times their truncation error are hidden by it.
constexpr double above_truncation = 3.0;

}  // namespace

double value_at(const SpherePoint& point, const Vector& field) {
  return evaluate_harmonics(field, Vector{{point.theta}}, Vector{{point.phi}})(0, 0);
}

namespace {

SphereDerivatives rotated(const Matrix3& rotation, const SphereDerivatives& x) {
  const Matrix3 t = rotation.transpose();
  return {x.value * t, x.d1 * t, x.d2 * t, x.d11 * t, x.d12 * t, x.d22 * t};
}

}  // namespace

std::array<double, 2> values_at_poles(const Vector3& direction, const SphereTransform& fine, const Vector3& point,
                                      const Matrix& position, const Vector& field) {
  const bool axisymmetric = fine.azimuthal_order() < fine.order();
  if (axisymmetric) {
    const SpherePoint up = higher_pole(position);
    const double above = value_at(up, field), below = value_at({std::numbers::pi - up.theta, 0.0}, field);
    return direction.z() > 0.0 ? std::array{above, below} : std::array{below, above};
  }
  Matrix centred = position;
  centred.row(0).setZero();
  const SphereDerivatives x = fine.synthesize_hessian(centred);
  std::array<double, 2> values{};
  for (const std::size_t side : {0U, 1U}) {
    const Vector3 up = side == 0 ? direction : Vector3(-direction);
    // Any rotation that turns the line upwards.
    const Matrix3 rotation = Eigen::Quaterniond::FromTwoVectors(up, Vector3::UnitZ()).toRotationMatrix();
    const auto pole =
        highest_on_line(rotation * point, fine.grid(), rotated(rotation, x), centred * rotation.transpose());
    values[side] = pole ? value_at(*pole, field) : std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

namespace {

/// Long axis of the gyration tensor in the x-z plane; for a body that is equally long in all directions of another
/// plane, the intersection of both planes. Zero if no direction of the x-z plane is longest.
Vector3 long_axis_in_plane(const Matrix3& gyration) {
  constexpr double kRounding = 1e-9;
  const auto [squares, axes] = principal_axes(gyration);
  Vector3 axis = axes.col(2);
  if (squares[2] - squares[1] <= kRounding * squares[2]) axis = Vector3::UnitY().cross(axes.col(0));
  if (squares[2] - squares[0] <= kRounding * squares[2]) axis.setZero();
  axis.y() = 0.0;
  return axis.norm() > kRounding ? axis : Vector3::Zero();
}

/// Angle of an axis in (−90, 90] degrees; a vertical one is +90, whatever its rounding.
double axis_angle_deg(double radians) {
  const double degrees = radians * 180.0 / std::numbers::pi;
  constexpr double kRounding = 1e-9;
  return degrees > 90.0 + kRounding ? degrees - 180.0 : degrees <= -90.0 + kRounding ? degrees + 180.0 : degrees;
}

/// Angle of the long axis of the gyration tensor against +x in the x-z plane of the laboratory, in (−90, 90] degrees.
double inclination(const Surface& s, const Frame& frame) {
  const Matrix centred = (s.position.rowwise() - centroid(s).transpose()) * frame.axes.transpose();
  const Vector3 axis = long_axis_in_plane(centred.transpose() * s.quadrature.asDiagonal() * centred);
  return axis_angle_deg(std::atan2(axis.z(), axis.x()));
}

/// ∫(H − c)² dA.
double elastic_energy_scaled(const Membrane& membrane, double c) {
  const Surface& s = membrane.surface;
  if (has_varying_bending(membrane)) {
    return (s.mean_curvature - membrane.material.spontaneous_curvature).cwiseAbs2().dot(s.quadrature);
  }
  return (s.mean_curvature.array() - c).square().matrix().dot(s.quadrature);
}

/// √(energy of x in degrees above 2p/3 over energy in degrees from 1 up).
double spectrum_tail(const Matrix& position) {
  const int order = order_of(position.rows());
  const Index from = n_coefficients(2 * order / 3);
  return position.bottomRows(position.rows() - from).norm() / position.bottomRows(position.rows() - 1).norm();
}

}  // namespace

VesicleDiagnostics along_lab_frame_axes(VesicleDiagnostics d, const Frame& frame, const SphereTransform& fine,
                                        const Surface& s, const SurfaceFields& membrane, const VesicleFields& fields) {
  // Relative to its mean, so that rounding does not depend on the position of the vesicle.
  const Vector3 mean = mean_vector(membrane.position);
  Matrix position = membrane.position * frame.axes.transpose();
  position.row(0).setZero();
  const SphereDerivatives x = fine.synthesize_hessian(position);
  const bool alternates = fields.potential_amplitude.size() > 0;
  if (membrane.transmembrane_potential.size() > 0 || alternates) {
    // Transforms without all azimuthal orders belong to states that are axisymmetric about z.
    const bool axisymmetric = fine.azimuthal_order() < fine.order();
    const std::optional<SpherePoint> north =
        axisymmetric ? higher_pole(position)
                     : highest_on_line(frame.axes * (centroid(s) - mean), fine.grid(), x, position);
    const auto there = [&](const Matrix& field) {
      if (!north) return std::numeric_limits<double>::quiet_NaN();
      const Matrix value = evaluate_harmonics(field, Vector{{north->theta}}, Vector{{north->phi}});
      return alternates ? value.norm() : value(0, 0);
    };
    d.Vm_north = there(alternates ? fields.potential_amplitude : Matrix(transmembrane_potential(membrane, fields)));
    d.q_north = there(alternates ? fields.charge_amplitude : Matrix(fields.charge));
  }
  const auto extent = [&](Index axis) {
    return maximum(fine.grid(), x, axis, position.col(axis), 1.0) +
           maximum(fine.grid(), x, axis, position.col(axis), -1.0);
  };
  d.extent_x = extent(0);
  d.extent_y = extent(1);
  d.extent_z = extent(2);
  d.inclination_deg = inclination(s, frame);
  return d;
}

namespace {

/// Largest magnitude of a scalar, between the nodes too.
double largest_magnitude(const SphereTransform& fine, const Vector& field) {
  const SphereDerivatives values = fine.synthesize_hessian(field);
  return std::max(maximum(fine.grid(), values, 0, field, 1.0), maximum(fine.grid(), values, 0, field, -1.0));
}

/// Position, motion and elongation of the membrane.
/// @param along_field  of any length; zero if the field has no direction
void add_moments(const Vector3& along_field, const Vector3& vorticity, const SphereTransform& fine, const Surface& s,
                 const Unknowns& rate, VesicleDiagnostics& d) {
  const VolumeMoments moments = volume_moments(s);
  std::tie(d.centroid_x, d.centroid_y, d.centroid_z) = components(moments.centroid);
  if (rate.position.size() > 0) {
    const Matrix velocity = fine.synthesize(rate.position);
    const Vector3 of_centroid = centroid_velocity(s, moments, velocity);
    std::tie(d.centroid_velocity_x, d.centroid_velocity_y, d.centroid_velocity_z) = components(of_centroid);
    const Matrix relative = velocity.rowwise() - of_centroid.transpose();
    const Vector along_normal = fine.analyze(Vector(relative.cwiseProduct(s.normal).rowwise().sum()));
    d.shape_rate = largest_magnitude(fine, along_normal) / std::sqrt(d.area / (4.0 * std::numbers::pi));
    if (!vorticity.isZero(0.0)) {
      const Turning turns = turning(s, moments, relative, vorticity);
      d.tumbling_angle_deg = axis_angle_deg(turns.angle);
      d.tumbling_frequency = turns.shape;
      d.treading_frequency = turns.membrane;
    }
  }
  d.aspect_ratio = moments.aspect_ratio();
  if (along_field.isZero(0.0)) return;
  d.aspect_ratio_field = moments.aspect_ratio_along(along_field);
  d.shape_modes = shape_modes(s, moments.centroid, along_field);
}

/// Magnitudes and phase of V_m in an averaged field.
void add_amplitudes(const Vector3& along_field, const SphereTransform& fine, const Surface& s,
                    const VesicleState& vesicle, const Matrix& amplitude, VesicleDiagnostics& d) {
  const Vector3 mean = mean_vector(vesicle.position);
  const auto at_poles = [&](Index part) {
    return values_at_poles(along_field, fine, centroid(s) - mean, vesicle.position, amplitude.col(part));
  };
  const auto [plus_real, minus_real] = at_poles(0);
  const auto [plus_imaginary, minus_imaginary] = at_poles(1);
  d.Vm_pole_plus = std::hypot(plus_real, plus_imaginary);
  d.Vm_pole_minus = std::hypot(minus_real, minus_imaginary);
  d.Vm_phase_deg = std::atan2(plus_imaginary, plus_real) * 180.0 / std::numbers::pi;
  // The magnitude has kinks, its square does not.
  const Vector square = fine.analyze(Vector(fine.synthesize(amplitude).rowwise().squaredNorm()));
  d.Vm_max = std::sqrt(maximum(fine.grid(), fine.synthesize_hessian(square), 0, square, 1.0));
}

/// Load of the poration criterion, and progress of poration.
void add_poration(const VesicleModel& model, const SphereTransform& fine, const Surface& s, const VesicleState& vesicle,
                  const VesicleSolution& solution, const VesicleFields& fields, VesicleDiagnostics& d) {
  if (model.criterion) {
    d.load = poration_load(*model.criterion, model.charging.capacitance, fine, vesicle, solution, fields);
    d.poration_load = d.load.load;
  }
  if (!model.reaction) return;
  // Both increase with the state of the reaction, whose maximum is smooth.
  const double most = maximum(fine.grid(), fine.synthesize_hessian(vesicle.poration), 0, vesicle.poration, 1.0);
  d.conductance_max =
      vesicle.material.conductance.size() > 0
          ? maximum(fine.grid(), fine.synthesize_hessian(fields.conductance), 0, fields.conductance, 1.0)
          : model.charging.conductance + model.reaction->conductance(most).value;
  d.poration_max = model.reaction->measure(most);
  const Vector measures =
      Vector(fine.synthesize(vesicle.poration)).unaryExpr([&](double state) { return model.reaction->measure(state); });
  d.poration_mean = measures.dot(s.quadrature) / d.area;
}

/// Sum of all forces on the fluid.
Vector3 net_force(const Membrane& membrane, const VesicleSolution& solution, const VesicleFields& fields) {
  const Surface& s = membrane.surface;
  Vector3 sum = Vector3::Zero();
  const auto add = [&](const Matrix& field, double sign) {
    if (field.size() > 0) sum += sign * membrane.fine.synthesize(field).transpose() * s.quadrature;
  };
  add(fields.force_bending, 1.0);
  add(fields.force_tension, 1.0);
  add(fields.force_electric, -1.0);
  add(fields.force_contact, 1.0);
  if (solution.force_of_effects.size() > 0) sum += solution.force_of_effects.transpose() * s.quadrature;
  return sum;
}

void add_sums_of_varying_membrane(const VesicleModel& model, const Membrane& membrane, const VesicleSolution& solution,
                                  const VesicleFields& fields, VesicleDiagnostics& d) {
  if (!model.has_varying_properties && !model.pump) return;
  if (model.bending) {
    d.elastic_energy =
        has_varying_bending(membrane) ? elastic_energy(membrane) : model.bending->modulus * d.elastic_energy_scaled;
  }
  std::tie(d.net_force_x, d.net_force_y, d.net_force_z) = components(net_force(membrane, solution, fields));
}

void check_operators(const MembraneSpace& space, double tolerance, const VesicleState& vesicle,
                     const Membrane& membrane, VesicleDiagnostics& d) {
  const LayerCheck check = check_layers(membrane);
  d.quadrature_error = check.error;
  d.quadrature_is_coarse = check.error > tolerance && check.error > above_truncation * check.truncation;
  d.separation = separation(space.transform(), vesicle.position, space.subspace().symmetry().axisymmetric);
}

}  // namespace

VesicleDiagnostics diagnose(const Model& model, const VesicleModel& vesicle_model, const MembraneSpace& space,
                            double quadrature_tolerance, const VesicleState& vesicle, const VesicleSolution& solution,
                            const VesicleFields& fields, const VesicleDiagnostics* previous) {
  const FlowParameters flow = flow_parameters(model, vesicle_model);
  const Vector3 along_field = model.electric ? model.electric->along() : Vector3(Vector3::Zero());
  double spontaneous_curvature = 0.0;
  for (const auto& effect : vesicle_model.effects) spontaneous_curvature += effect->spontaneous_curvature();
  const Membrane& membrane = *solution.membrane;
  const Surface& s = membrane.surface;
  const SphereTransform& fine = membrane.fine;
  VesicleDiagnostics d;
  d.area = surface_area(s);
  d.volume = enclosed_volume(s);
  d.reduced_volume = 6.0 * std::sqrt(std::numbers::pi) * d.volume / (d.area * std::sqrt(d.area));
  d.bending_energy_scaled = bending_energy_scaled(s);
  d.elastic_energy_scaled = elastic_energy_scaled(membrane, spontaneous_curvature);
  // The area of a membrane with undulations is not held but follows the tension.
  d.area_drift = vesicle_model.undulations ? 0.0 : d.area / vesicle.reference_area - 1.0;
  d.volume_drift = d.volume / vesicle.reference_volume - 1.0;
  d.strain_max = fine.synthesize(vesicle.area_strain).cwiseAbs().maxCoeff();
  d.spectrum_tail = spectrum_tail(vesicle.position);
  add_moments(along_field, model.flow ? vorticity(*model.flow) : Vector3(Vector3::Zero()), fine, s, solution.rate, d);
  if (fields.tension.size() > 0) {
    const Vector tension = fine.synthesize(fields.tension);
    d.tension_integral = tension.dot(s.quadrature);
    d.tension_max = maximum(fine.grid(), fine.synthesize_hessian(fields.tension), 0, fields.tension, 1.0);
    // The tension of a sphere is determined up to its mean.
    if (!solution.is_sphere) {
      d.wrinkle_degree = wrinkle_degree(flow, tension.minCoeff(), membrane.radius);
      d.wrinkling_rate = wrinkling_rate(flow, d.tension_integral / d.area, membrane.radius, fine.order());
    }
  }
  if (fields.potential_amplitude.size() > 0) {
    add_amplitudes(along_field, fine, s, vesicle, fields.potential_amplitude, d);
  }
  const Vector& potential = transmembrane_potential(vesicle, fields);
  if (potential.size() > 0) {
    if (!along_field.isZero(0.0)) {
      const Vector3 mean = mean_vector(vesicle.position);
      const auto [plus, minus] = values_at_poles(along_field, fine, centroid(s) - mean, vesicle.position, potential);
      d.Vm_pole_plus = plus;
      d.Vm_pole_minus = minus;
    }
    d.Vm_max = largest_magnitude(fine, potential);
  }
  add_poration(vesicle_model, fine, s, vesicle, solution, fields, d);
  add_sums_of_varying_membrane(vesicle_model, membrane, solution, fields, d);
  if (model.wall) {
    d.gap_wall = nearest_to_wall(*model.wall, fine, vesicle.position).distance;
    d.force_wall = -model.wall->normal.dot(net_force(membrane, solution, fields));
  }
  if (previous != nullptr) {
    d.quadrature_error = previous->quadrature_error;
    d.quadrature_is_coarse = previous->quadrature_is_coarse;
    d.separation = previous->separation;
  } else {
    check_operators(space, quadrature_tolerance, vesicle, membrane, d);
  }
  return along_lab_frame_axes(d, Frame{}, fine, s, vesicle, fields);
}

}  // namespace vehd
