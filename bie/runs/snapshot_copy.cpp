#include "bie/runs/snapshot_copy.hpp"

#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/resized.hpp"

namespace vehd {

namespace {

/// @param number  of the vesicle
void read_vesicle(const RunSnapshot& source, std::size_t number, VesicleState& vesicle, VesicleFields& fields) {
  const auto read = [&](const char* field, Index components) {
    return source.has_field(field, number) ? source.coefficients(field, components, number) : Matrix();
  };
  const auto matrix = [&](const char* field) { return read(field, 3); };
  const auto vector = [&](const char* field) -> Vector { return read(field, 1).reshaped(); };
  const auto amplitude = [&](const char* real, const char* imaginary) {
    Matrix parts(vesicle.position.rows(), 2);
    parts << source.coefficients(real, 1, number), source.coefficients(imaginary, 1, number);
    return parts;
  };
  vesicle.position = source.coefficients("x", 3, number);
  vesicle.transmembrane_potential = vector("Vm");
  vesicle.area_strain = vector("area_strain");
  vesicle.poration = vector("poration");
  // Of pores, or of the place.
  (vesicle.poration.size() > 0 ? fields.conductance : vesicle.material.conductance) = vector("conductance");
  vesicle.material.capacitance = vector("capacitance");
  vesicle.material.pump_current = vector("pump_current");
  vesicle.material.bending_modulus = vector("bending_modulus");
  vesicle.material.spontaneous_curvature = vector("spontaneous_curvature");
  fields.velocity = matrix("velocity");
  fields.force_bending = matrix("force_bending");
  fields.force_tension = matrix("force_tension");
  fields.force_electric = matrix("force_electric");
  fields.force_contact = matrix("force_contact");
  fields.tension = vector("tension");
  fields.charge = vector("q");
  fields.free_charge_in = vector("free_charge_in");
  fields.free_charge_out = vector("free_charge_out");
  if (source.has_field("Vm_real", number)) {
    fields.potential_amplitude = amplitude("Vm_real", "Vm_imaginary");
    fields.charge_amplitude = amplitude("q_real", "q_imaginary");
  }
}

}  // namespace

std::int64_t copy_snapshot(Hdf5Writer& target, const RunReader& source, std::size_t number,
                           const SphereTransform& transform, const SiUnits& si_units) {
  const RunSnapshot snapshot = source.snapshot(number);
  State state;
  state.time = snapshot.time();
  state.step = snapshot.step();
  Fields fields;
  for (std::size_t a = 0; a < snapshot.n_vesicles(); ++a) {
    VesicleState vesicle;
    VesicleFields of_vesicle;
    read_vesicle(snapshot, a, vesicle, of_vesicle);
    state.vesicles.push_back(resized(std::move(vesicle), snapshot.degree(a)));
    fields.vesicles.push_back(resized(std::move(of_vesicle), snapshot.degree(a)));
  }
  return write_snapshot(target, snapshot_name(static_cast<std::int64_t>(number)), transform, state, fields, si_units);
}

}  // namespace vehd
