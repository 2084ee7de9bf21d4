#include "bie/stepping/state/rheology.hpp"

#include <array>

#include "bie/physics/rotated.hpp"

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
  // From one of them, so that far from the origin nothing cancels.
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

}  // namespace vehd
