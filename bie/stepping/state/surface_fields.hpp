#pragma once

#include "bie/physics/membrane_material.hpp"
#include "bie/support/ranks/parcel.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// What rides on the material points of one membrane, in spherical-harmonic coefficients of one degree, index
/// n² + n + m (docs/conventions.md). Fields of absent effects are empty.
struct SurfaceFields {
  Matrix position;     ///< x, [n_coefficients x 3]
  Vector area_strain;  ///< W/W_ref − 1
  /// V_m, interior minus exterior; empty without electricity. With displacement currents the charge of the inner face
  /// over C_m, which is continuous where the field jumps, see FaceCharges.
  Vector transmembrane_potential;
  Vector free_charge;           ///< of both faces over C_m; empty without displacement currents
  Vector tension;               ///< λ, also the initial guess of the next solve; empty unless inextensible
  Vector poration{};            ///< s of the membrane's PorationReaction; empty without
  MembraneMaterial material{};  ///< what differs from place to place
};

/// The scalars among them that are there, one after the other: visit(Vector&).
template <typename Fields, typename Visit>
void for_each_scalar(Fields& fields, const Visit& visit) {
  for (auto* scalar :
       {&fields.area_strain, &fields.transmembrane_potential, &fields.free_charge, &fields.tension, &fields.poration}) {
    if (scalar->size() > 0) visit(*scalar);
  }
  for_each_property(fields.material, visit);
}

template <MaybeConst<SurfaceFields> Fields, typename Visit>
void visit_members(Fields& fields, Visit& visit) {
  auto& [position, area_strain, transmembrane_potential, free_charge, tension, poration, material] = fields;
  visit(position, area_strain, transmembrane_potential, free_charge, tension, poration);
  auto& [capacitance, conductance, pump_current, bending_modulus, spontaneous_curvature] = material;
  visit(capacitance, conductance, pump_current, bending_modulus, spontaneous_curvature);
}

/// x and the scalars that for_each(fields, visit) visits, one behind the other, [n_coefficients x 3 …].
template <typename ForEachScalar>
Matrix columns_of(const SurfaceFields& fields, const ForEachScalar& for_each) {
  Index n_scalars = 0;
  for_each(fields, [&](const Vector&) { ++n_scalars; });
  Matrix columns(fields.position.rows(), 3 + n_scalars);
  columns.leftCols(3) = fields.position;
  Index column = 3;
  for_each(fields, [&](const Vector& scalar) { columns.col(column++) = scalar; });
  return columns;
}

}  // namespace vehd
