#include "bie/runs/snapshot_copy.hpp"

#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/resized.hpp"

namespace vehd {

namespace {

/// @param group  of the vesicle
void read_vesicle(const Hdf5Reader& source, const std::string& group, VesicleState& vesicle, VesicleFields& fields) {
  const auto matrix = [&](const char* field) {
    const std::string dataset = group + "/coefficients/" + field;
    return source.has(dataset) ? source.matrix(dataset) : Matrix();
  };
  const auto vector = [&](const char* field) {
    const Matrix values = matrix(field);
    return values.size() == 0 ? Vector() : Vector(values.col(0));
  };
  const auto amplitude = [&](const char* real, const char* imaginary) {
    const Matrix first = matrix(real), second = matrix(imaginary);
    Matrix parts(first.rows(), first.cols() + second.cols());
    parts << first, second;
    return parts;
  };
  vesicle.position = matrix("x");
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
  if (source.has(group + "/coefficients/Vm_real")) {
    fields.potential_amplitude = amplitude("Vm_real", "Vm_imaginary");
    fields.charge_amplitude = amplitude("q_real", "q_imaginary");
  }
}

}  // namespace

std::int64_t copy_snapshot(Hdf5Writer& target, const Hdf5Reader& source, const std::string& name,
                           const SphereTransform& transform, const SiUnits& si_units) {
  const std::string group = "/snapshots/" + name;
  State state;
  state.time = source.number_attribute(group, "time");
  state.step = source.integer_attribute(group, "step");
  Fields fields;
  for (const std::string& of_vesicle : vesicle_groups(source, group)) {
    VesicleState vesicle;
    VesicleFields of_fields;
    read_vesicle(source, of_vesicle, vesicle, of_fields);
    const int degree = solved_degree(source, of_vesicle);
    state.vesicles.push_back(resized(std::move(vesicle), degree));
    fields.vesicles.push_back(resized(std::move(of_fields), degree));
  }
  return write_snapshot(target, name, transform, state, fields, si_units);
}

}  // namespace vehd
