#include "bie/stepping/state/state.hpp"

#include <algorithm>
#include <utility>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/field_table.hpp"

namespace vehd {

namespace {

/// Absent fields stay absent.
Matrix resized(const Matrix& coefficients, int order) {
  return coefficients.size() == 0 ? coefficients : resize_order(coefficients, order);
}

template <typename Fields>
void resize(Fields& fields, int order) {
  for_each_field([&](const FieldRow&, auto& field) { field = resized(Matrix(field), order); }, fields);
}

}  // namespace

VesicleState resized(VesicleState vesicle, int order) {
  if (n_coefficients(order) != vesicle.position.rows()) vesicle.recycled = {};
  resize(vesicle, order);
  vesicle.past = resized(vesicle.past, order);
  return vesicle;
}

VesicleFields resized(VesicleFields fields, int order) {
  resize(fields, order);
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

double state_difference(const State& state, const State& reference) {
  double largest = 0.0;
  const auto add = [&](const FieldRow&, const auto& a, const auto& b) {
    const double size = b.size() > 0 ? b.cwiseAbs().maxCoeff() : 0.0;
    if (size > 0.0) largest = std::max(largest, (a - b).cwiseAbs().maxCoeff() / size);
  };
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    for_each_unknown(add, state.vesicles[a], reference.vesicles[a]);
  }
  return largest;
}

}  // namespace vehd
