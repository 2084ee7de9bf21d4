#include "bie/runs/snapshot_copy.hpp"

#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

namespace {

/// @param number  number of the vesicle
void read_vesicle(const RunSnapshot& source, std::size_t number, VesicleState& vesicle, VesicleFields& fields) {
  const auto read = [&](const std::string& field, Index components) {
    // An effect may be absent, the shape may not.
    const bool is_there = field == "x" || source.has_field(field, number);
    return is_there ? source.coefficients(field, components, number) : Matrix();
  };
  const auto amplitude = [&](const char* real, const char* imaginary) {
    Matrix parts(vesicle.position.rows(), 2);
    parts << source.coefficients(real, 1, number), source.coefficients(imaginary, 1, number);
    return parts;
  };
  const auto read_into = [&](const FieldRow& row, auto& field) {
    if (!row.dataset.empty()) field = read(std::string(row.dataset), row.kind == FieldKind::vector ? 3 : 1);
  };
  for_each_field(read_into, vesicle);
  for_each_field(read_into, fields);
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
