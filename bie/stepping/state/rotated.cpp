#include "bie/stepping/state/rotated.hpp"

#include "bie/physics/rotated.hpp"
#include "bie/sphere/rotation.hpp"

namespace vehd {

namespace {

Matrix rotated_vectors(const Matrix3& rotation, const Matrix& coefficients) {
  if (coefficients.size() == 0) return coefficients;
  return rotated_fields(coefficients, rotation) * rotation.transpose();
}

/// Every column by itself.
Matrix rotated_scalars(const Matrix3& rotation, const Matrix& coefficients) {
  if (coefficients.size() == 0) return coefficients;
  return rotated_fields(coefficients, rotation);
}

Vector rotated_scalar(const Matrix3& rotation, const Vector& coefficients) {
  if (coefficients.size() == 0) return coefficients;
  return rotated_fields(coefficients, rotation);
}

}  // namespace

Model rotated(const Matrix3& rotation, Model model) {
  if (model.flow) model.flow->gradient = rotated_tensor(rotation, model.flow->gradient);
  if (model.electric) model.electric->field = rotated_vector(rotation, model.electric->field);
  for (auto& effect : model.effects) effect = effect->rotated(rotation);
  for (VesicleModel& vesicle : model.vesicles) {
    for (auto& effect : vesicle.effects) effect = effect->rotated(rotation);
  }
  return model;
}

State rotated(const Matrix3& rotation, State state) {
  if (rotation.isIdentity(0.0)) return state;
  for (VesicleState& vesicle : state.vesicles) {
    vesicle.position = rotated_vectors(rotation, vesicle.position);
    for_each_scalar(vesicle, [&](Vector& scalar) { scalar = rotated_scalar(rotation, scalar); });
    if (vesicle.crossing) vesicle.crossing->place = rotation * vesicle.crossing->place;
    // In the coefficients of other axes, with another symmetry: solves there learn anew.
    vesicle.recycled = {};
  }
  return without_past(std::move(state));
}

Fields rotated(const Matrix3& rotation, Fields fields) {
  if (rotation.isIdentity(0.0)) return fields;
  for (VesicleFields& f : fields.vesicles) {
    for (Matrix* vectors : {&f.velocity, &f.force_bending, &f.force_tension, &f.force_electric, &f.force_contact}) {
      *vectors = rotated_vectors(rotation, *vectors);
    }
    f.tension = rotated_scalar(rotation, f.tension);
    f.charge = rotated_scalar(rotation, f.charge);
    f.potential = rotated_scalar(rotation, f.potential);
    f.conductance = rotated_scalar(rotation, f.conductance);
    f.free_charge_in = rotated_scalar(rotation, f.free_charge_in);
    f.free_charge_out = rotated_scalar(rotation, f.free_charge_out);
    f.potential_amplitude = rotated_scalars(rotation, f.potential_amplitude);
    f.charge_amplitude = rotated_scalars(rotation, f.charge_amplitude);
  }
  return fields;
}

}  // namespace vehd
