#include "bie/stepping/state/resized.hpp"

#include <algorithm>
#include <utility>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Absent fields stay absent.
Matrix resized(const Matrix& coefficients, int order) {
  return coefficients.size() == 0 ? coefficients : resize_order(coefficients, order);
}

}  // namespace

VesicleState resized(VesicleState vesicle, int order) {
  if (n_coefficients(order) != vesicle.position.rows()) vesicle.recycled = {};
  vesicle.position = resized(vesicle.position, order);
  for_each_scalar(vesicle, [&](Vector& scalar) { scalar = resized(Matrix(scalar), order); });
  vesicle.past = resized(vesicle.past, order);
  return vesicle;
}

VesicleFields resized(VesicleFields fields, int order) {
  for (Matrix* field : {&fields.velocity, &fields.force_bending, &fields.force_tension, &fields.force_electric,
                        &fields.force_contact, &fields.potential_amplitude, &fields.charge_amplitude}) {
    *field = resized(*field, order);
  }
  for (Vector* field : {&fields.charge, &fields.potential, &fields.tension, &fields.conductance, &fields.free_charge_in,
                        &fields.free_charge_out}) {
    *field = resized(Matrix(*field), order);
  }
  return fields;
}

State resized(State state, int order) {
  for (VesicleState& vesicle : state.vesicles) vesicle = resized(std::move(vesicle), order);
  return state;
}

Fields resized(Fields fields, int order) {
  for (VesicleFields& vesicle : fields.vesicles) vesicle = resized(std::move(vesicle), order);
  return fields;
}

int highest_order_of(const State& state) {
  int highest = 0;
  for (const VesicleState& vesicle : state.vesicles) highest = std::max(highest, order_of(vesicle.position.rows()));
  return highest;
}

}  // namespace vehd
