#include "bie/stepping/state/rheology.hpp"

#include <array>
#include <numbers>

#include "bie/physics/averaged_field.hpp"
#include "bie/physics/rotated.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"
#include "bie/stepping/evaluation/volume_moments.hpp"

namespace vehd {

namespace {

constexpr std::array shares = {&Rheology::bending, &Rheology::tension, &Rheology::electric, &Rheology::others,
                               &Rheology::viscosity};

}  // namespace

Matrix3 Rheology::moment() const {
  Matrix3 sum = Matrix3::Zero();
  for (const auto share : shares) sum += this->*share;
  return sum;
}

double Rheology::power() const { return moment().cwiseProduct(gradient).sum() + electric_power; }

double Rheology::intrinsic_viscosity() const {
  const Matrix3 strain = 0.5 * (gradient + gradient.transpose());
  if (strain.isZero(0.0)) return 0.0;
  return moment().cwiseProduct(strain).sum() / (2.0 * fluid_viscosity * strain.squaredNorm() * volume);
}

Rheology together(const std::vector<Rheology>& vesicles) {
  Rheology all;
  all.gradient = vesicles.front().gradient;
  all.fluid_viscosity = vesicles.front().fluid_viscosity;
  // Relative to one of them, so that nothing cancels far from the origin.
  const Vector3 from = vesicles.front().centre;
  for (const Rheology& one : vesicles) {
    all.volume += one.volume;
    all.centre += one.volume * (one.centre - from);
  }
  all.centre = from + all.centre / all.volume;
  for (const Rheology& one : vesicles) {
    for (const auto share : shares) all.*share += one.*share;
    const Vector3 offset = one.centre - all.centre;
    all.electric -= one.electric_force * offset.transpose();
    all.others -= one.other_force * offset.transpose();
    all.electric_force += one.electric_force;
    all.other_force += one.other_force;
    all.dipole += one.dipole;
    all.electric_power += one.electric_power;
  }
  return all;
}

Rheology rotated(const Matrix3& rotation, const Vector3& origin, Rheology rheology) {
  for (const auto share : shares) rheology.*share = rotated_tensor(rotation, rheology.*share);
  rheology.gradient = rotated_tensor(rotation, rheology.gradient);
  for (const auto vector : {&Rheology::electric_force, &Rheology::other_force, &Rheology::dipole}) {
    rheology.*vector = rotated_vector(rotation, rheology.*vector);
  }
  rheology.centre = origin + rotation * rheology.centre;
  return rheology;
}

namespace {

/// ∫ a bᵀ dA of vectors, [n_points x 3].
Matrix3 integral_of_products(const Surface& s, const Matrix& a, const Matrix& b) {
  return a.transpose() * s.quadrature.asDiagonal() * b;
}

/// ∫ (q x − V n) dA.
Vector3 dipole_over_permittivity(const Membrane& membrane, const Matrix& y, const Vector& potential,
                                 const Vector& charge) {
  const Surface& s = membrane.surface;
  const Vector q = membrane.fine.synthesize(charge).cwiseProduct(s.quadrature);
  const Vector v = membrane.fine.synthesize(potential).cwiseProduct(s.quadrature);
  return y.transpose() * q - s.normal.transpose() * v;
}

void add_electric(const ElectricParameters& electric, const Membrane& membrane, const Matrix& y,
                  const VesicleState& state, const VesicleFields& fields, Rheology& r) {
  if (electric.averaged_frequency) {
    if (fields.potential_amplitude.size() == 0) return;
    const auto part = [&](Index i) {
      return dipole_over_permittivity(membrane, y, fields.potential_amplitude.col(i), fields.charge_amplitude.col(i));
    };
    const Vector3 in_phase = part(0), behind = part(1);
    const std::complex<double> outside = complex_conductivities(electric).outside;
    r.dipole = electric.permittivity * in_phase;
    r.electric_power = 0.5 * electric.field.dot(outside.real() * in_phase - outside.imag() * behind);
    return;
  }
  const Vector3 dipole = dipole_over_permittivity(membrane, y, transmembrane_potential(state, fields), fields.charge);
  r.dipole = electric.permittivity * dipole;
  r.electric_power = electric.conductivity_out * electric.field.dot(dipole);
}

/// Symmetric part of a matrix, without its trace.
Matrix3 deviator(const Matrix3& m) {
  const Matrix3 symmetric = 0.5 * (m + m.transpose());
  return symmetric - symmetric.trace() / 3.0 * Matrix3::Identity();
}

/// An inextensible sphere moves only rigidly, although the tension found keeps its area elements only at this instant:
/// the further tension that makes it rigid is added here. A disturbance u on a sphere has the stress −5μ ∫ ½(u nᵀ + n
/// uᵀ) dA by the reciprocal theorem with the flow about a rigid sphere.
void make_rigid(const Surface& s, const Matrix& velocity, Rheology& r) {
  r.tension += 5.0 * r.fluid_viscosity * deviator(integral_of_products(s, velocity, s.normal)) + r.viscosity;
  r.viscosity.setZero();
}

}  // namespace

Rheology find_rheology(const Model& model, const VesicleModel& vesicle, double time, Limit limit,
                       const VesicleState& state, const VesicleSolution& solution, const VesicleFields& fields) {
  const Membrane& membrane = *solution.membrane;
  const Surface& s = membrane.surface;
  Rheology r;
  r.volume = enclosed_volume(s);
  r.centre = volume_moments(s).centroid;
  r.fluid_viscosity = model.viscosity;
  const Matrix y = s.position.rowwise() - r.centre.transpose();
  if (model.electric) {
    add_electric(electric_parameters(model, vesicle).at(time, limit), membrane, y, state, fields, r);
  }
  if (!model.mobile) return r;
  if (model.flow) r.gradient = model.flow->waveform.at(time, limit) * model.flow->gradient;
  const auto add_force = [&](const Matrix& values, Matrix3& share, Vector3* total) {
    share = -integral_of_products(s, values, y);
    if (total != nullptr) *total = values.transpose() * s.quadrature;
  };
  if (fields.force_bending.size() > 0) add_force(membrane.fine.synthesize(fields.force_bending), r.bending, nullptr);
  if (fields.force_tension.size() > 0) add_force(membrane.fine.synthesize(fields.force_tension), r.tension, nullptr);
  // The force on the fluid is −f_E.
  if (fields.force_electric.size() > 0) {
    add_force(-membrane.fine.synthesize(fields.force_electric), r.electric, &r.electric_force);
  }
  Matrix others = solution.force_of_effects;
  if (fields.force_contact.size() > 0) {
    if (others.size() == 0) others.setZero(s.n_points(), 3);
    others += membrane.fine.synthesize(fields.force_contact);
  }
  if (others.size() > 0) add_force(others, r.others, &r.other_force);
  if (vesicle.viscosity_ratio != 1.0) {
    const Matrix3 products = integral_of_products(s, membrane.fine.synthesize(fields.velocity), s.normal);
    r.viscosity = model.viscosity * (vesicle.viscosity_ratio - 1.0) * (products + products.transpose());
  }
  if (solution.is_sphere) make_rigid(s, membrane.fine.synthesize(fields.velocity), r);
  return r;
}

}  // namespace vehd
