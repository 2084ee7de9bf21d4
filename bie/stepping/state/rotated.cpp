#include "bie/stepping/state/rotated.hpp"

#include "bie/physics/rotated.hpp"
#include "bie/sphere/rotation.hpp"
#include "bie/stepping/state/field_table.hpp"

namespace vehd {

namespace {

template <typename Fields>
void turn(Fields& fields, const Matrix3& rotation) {
  for_each_field(
      [&](const FieldRow& row, auto& field) {
        if (field.size() == 0) return;
        field = rotated_fields(field, rotation);
        if constexpr (std::is_same_v<decltype(field), Matrix&>) {
          if (row.kind == FieldKind::vector) field = (field * rotation.transpose()).eval();
        }
      },
      fields);
}

}  // namespace

Model rotated(const Matrix3& rotation, Model model) {
  if (model.flow) model.flow->gradient = rotated_tensor(rotation, model.flow->gradient);
  if (model.electric) model.electric->field = rotated_vector(rotation, model.electric->field);
  if (model.wall) {
    model.wall->point = rotation * model.wall->point;
    model.wall->normal = rotated_vector(rotation, model.wall->normal);
  }
  for (auto& effect : model.effects) effect = effect->rotated(rotation);
  for (VesicleModel& vesicle : model.vesicles) {
    for (auto& effect : vesicle.effects) effect = effect->rotated(rotation);
  }
  return model;
}

State rotated(const Matrix3& rotation, State state) {
  if (rotation.isIdentity(0.0)) return state;
  for (VesicleState& vesicle : state.vesicles) {
    turn(vesicle, rotation);
    if (vesicle.crossing) vesicle.crossing->place = rotation * vesicle.crossing->place;
    // In the coefficients of other axes, with another symmetry: solves there learn anew.
    vesicle.recycled = {};
  }
  return without_past(std::move(state));
}

Fields rotated(const Matrix3& rotation, Fields fields) {
  if (rotation.isIdentity(0.0)) return fields;
  for (VesicleFields& vesicle : fields.vesicles) turn(vesicle, rotation);
  return fields;
}

}  // namespace vehd
