#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

#include "bie/stepping/state/fields.hpp"
#include "bie/support/ranks/parcel.hpp"

/// The fields of a membrane, one row each. All code that remaps, rotates, resizes, compares, sends, stores or reads
/// fields iterates over these tables; a new field needs only its member and its row.
namespace vehd {

enum class FieldKind {
  vector,     ///< components turn with the axes
  scalar,     ///< unchanged by maps
  potential,  ///< changes sign under maps that reverse the field
};

enum class FieldRole {
  unknown,   ///< steps solve for it
  carried,   ///< moves with the material
  guess,     ///< initial guess of the next solve, no more
  computed,  ///< follows from the others at the same time
};

struct FieldRow {
  const char* name;          ///< of the member, and in a checkpoint
  std::string_view dataset;  ///< in run.h5; empty: not written, or under another field's name
  FieldKind kind;
  FieldRole role;
  std::string_view dimension;  ///< in the notation of SiUnits
  std::string_view description;
};

template <typename Fields>
concept OfUnknowns = std::derived_from<std::remove_const_t<Fields>, Unknowns>;

template <typename Fields>
concept OfSurface = std::derived_from<std::remove_const_t<Fields>, SurfaceFields>;

template <typename Fields>
concept OfVesicle = std::derived_from<std::remove_const_t<Fields>, VesicleFields>;

/// Calls visit(row, member, …) for every field, empty or not, with that member of each argument.
template <typename Visit, OfUnknowns... Fields>
void for_each_unknown(const Visit& visit, Fields&... f) {
  using enum FieldKind;
  using enum FieldRole;
  const auto row = [&](const FieldRow& of, auto&... members) { visit(of, members...); };
  row({"position", "x", vector, unknown, "length", "membrane position x"}, f.position...);
  row({"transmembrane_potential", "Vm", potential, unknown, "potential",
       "transmembrane potential V_m = [[phi]], interior minus exterior"},
      f.transmembrane_potential...);
  row({"free_charge", "", potential, unknown, "potential", "free charge of both faces over C_m"}, f.free_charge...);
  row({"poration", "poration", scalar, unknown, "1",
       "state of poration: porosity X, or ln(N/N_0) of a density N of pores"},
      f.poration...);
}

template <typename Visit, std::same_as<Unknowns>... Fields>
void for_each_field(const Visit& visit, Fields&... f) {
  for_each_unknown(visit, f...);
}

template <typename Visit, std::same_as<const Unknowns>... Fields>
void for_each_field(const Visit& visit, Fields&... f) {
  for_each_unknown(visit, f...);
}

template <typename Visit, OfSurface... Fields>
void for_each_field(const Visit& visit, Fields&... f) {
  using enum FieldKind;
  using enum FieldRole;
  for_each_unknown(visit, f...);
  const auto row = [&](const FieldRow& of, auto&... members) { visit(of, members...); };
  row({"area_strain", "area_strain", scalar, carried, "1", "area strain W/W_ref - 1 of the material"},
      f.area_strain...);
  row({"tension", "", scalar, guess, "force/length", "membrane tension lambda"}, f.tension...);
  row({"capacitance", "capacitance", scalar, carried, "capacitance/area", "capacitance C_m where it varies"},
      f.material.capacitance...);
  row({"conductance", "conductance", scalar, carried, "conductance/area", "conductance G_m where it varies"},
      f.material.conductance...);
  row({"pump_current", "pump_current", potential, carried, "current/area",
       "pump current J_p, outwards, where its waveform is 1"},
      f.material.pump_current...);
  row({"bending_modulus", "bending_modulus", scalar, carried, "energy", "bending modulus kappa_B where it or c varies"},
      f.material.bending_modulus...);
  row({"spontaneous_curvature", "spontaneous_curvature", scalar, carried, "1/length",
       "spontaneous curvature c where it or kappa_B varies"},
      f.material.spontaneous_curvature...);
}

template <typename Visit, OfVesicle... Fields>
void for_each_field(const Visit& visit, Fields&... f) {
  using enum FieldKind;
  using enum FieldRole;
  const auto row = [&](const FieldRow& of, auto&... members) { visit(of, members...); };
  row({"velocity", "velocity", vector, computed, "velocity", "membrane velocity dx/dt"}, f.velocity...);
  row({"force_bending", "force_bending", vector, computed, "force/area", "bending force f_b on the fluid"},
      f.force_bending...);
  row({"force_tension", "force_tension", vector, computed, "force/area", "tension force f_lambda on the fluid"},
      f.force_tension...);
  row({"force_electric", "force_electric", vector, computed, "force/area",
       "electric force f_E = [[n . Sigma_el]]; f = f_b + f_lambda - f_E"},
      f.force_electric...);
  row({"force_contact", "force_contact", vector, computed, "force/area", "force of the contact potential on the fluid"},
      f.force_contact...);
  row({"tension", "tension", scalar, computed, "force/length", "membrane tension lambda"}, f.tension...);
  row({"charge", "q", potential, computed, "potential/length", "q = [[d phi/d n]], interior minus exterior"},
      f.charge...);
  row({"conductance", "", scalar, computed, "conductance/area", "conductance G_m of pores"}, f.conductance...);
  row({"potential", "", potential, computed, "potential", "V_m where it follows from free charges"}, f.potential...);
  row({"potential_amplitude", "", potential, computed, "potential", "complex amplitude of V_m"},
      f.potential_amplitude...);
  row({"charge_amplitude", "", potential, computed, "potential/length", "complex amplitude of q"},
      f.charge_amplitude...);
  row({"free_charge_in", "free_charge_in", potential, computed, "charge/area",
       "free charge of the inner face, C_m V_m - epsilon_i E_i"},
      f.free_charge_in...);
  row({"free_charge_out", "free_charge_out", potential, computed, "charge/area",
       "free charge of the outer face, epsilon_e E_e - C_m V_m"},
      f.free_charge_out...);
}

/// Calls visit(Vector&) for every scalar and potential that is not empty.
template <OfSurface Fields, typename Visit>
void for_each_scalar(Fields& fields, const Visit& visit) {
  for_each_field(
      [&](const FieldRow&, auto& field) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, Vector>) {
          if (field.size() > 0) visit(field);
        }
      },
      fields);
}

/// Are the position and all scalars finite?
inline bool is_finite(const SurfaceFields& fields) {
  bool result = fields.position.allFinite();
  for_each_scalar(fields, [&](const Vector& values) { result = result && values.allFinite(); });
  return result;
}

/// Visits all members, for messages between ranks.
template <MaybeConst<Unknowns> Fields, typename Visit>
void visit_members(Fields& fields, Visit& visit) {
  for_each_unknown([&](const FieldRow&, auto& field) { visit(field); }, fields);
}

template <MaybeConst<SurfaceFields> Fields, typename Visit>
void visit_members(Fields& fields, Visit& visit) {
  for_each_field([&](const FieldRow&, auto& field) { visit(field); }, fields);
}

template <MaybeConst<VesicleFields> Fields, typename Visit>
void visit_members(Fields& fields, Visit& visit) {
  for_each_field([&](const FieldRow&, auto& field) { visit(field); }, fields);
}

/// Calls visit(field, first column) for every field that is not empty, with its first column in columns_of().
/// @return the number of all columns
template <typename Fields, typename Visit>
Index for_each_block(Fields& fields, const Visit& visit) {
  Index column = 0;
  for_each_field(
      [&](const FieldRow&, auto& field) {
        if (field.size() == 0) return;
        visit(field, column);
        column += field.cols();
      },
      fields);
  return column;
}

/// All fields that are not empty, side by side, [n_coefficients x 3 …].
template <typename Fields>
Matrix columns_of(const Fields& fields) {
  Matrix columns(fields.position.rows(), for_each_block(fields, [](const auto&, Index) {}));
  for_each_block(fields, [&](const auto& field, Index first) { columns.middleCols(first, field.cols()) = field; });
  return columns;
}

}  // namespace vehd
