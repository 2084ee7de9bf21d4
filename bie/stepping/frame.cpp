#include "bie/stepping/frame.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "bie/physics/turned.hpp"
#include "bie/sphere/rotation.hpp"
#include "bie/stepping/composition.hpp"
#include "bie/stepping/symmetry.hpp"

namespace vehd {

namespace {

constexpr double kRounding = 1e-12;

bool are_parallel(const Vector3& a, const Vector3& b) { return a.cross(b).norm() <= kRounding * a.norm() * b.norm(); }

/// Unit vectors, no two of them parallel; coordinate axes come first, because nothing is rounded there.
std::vector<Vector3> axis_candidates(const Model& model, const State& state) {
  std::vector<Vector3> result{Vector3::UnitZ(), Vector3::UnitX(), Vector3::UnitY()};
  const auto add = [&](const Vector3& axis) {
    if (!(axis.norm() > 0.0)) return;
    const auto parallel = [&](const Vector3& known) { return are_parallel(known, axis); };
    if (std::none_of(result.begin(), result.end(), parallel)) result.push_back(axis.normalized());
  };
  if (model.electric) add(model.electric->field);
  for (const auto& effect : explicit_effects(model)) {
    for (const Vector3& axis : effect->axis_candidates()) add(axis);
  }
  // ∫ x xᵀ over the parameter sphere has the axes of the shape.
  const Matrix shape = state.position.bottomRows(state.position.rows() - 1);
  const Eigen::SelfAdjointEigenSolver<Matrix3> moments(Matrix3(shape.transpose() * shape));
  for (int i = 0; i < 3; ++i) add(moments.eigenvectors().col(i));
  return result;
}

bool allows_axis(const Model& model) {
  const auto effects = explicit_effects(model);
  return (!model.electric || model.electric->field.head<2>().isZero(0.0)) &&
         std::all_of(effects.begin(), effects.end(), [](const auto& effect) { return effect->allows_axis(); });
}

Matrix turned_vectors(const Matrix3& rotation, const Matrix& coefficients) {
  if (coefficients.size() == 0) return coefficients;
  return turned_fields(coefficients, rotation) * rotation.transpose();
}

Vector turned_scalar(const Matrix3& rotation, const Vector& coefficients) {
  if (coefficients.size() == 0) return coefficients;
  return turned_fields(coefficients, rotation);
}

}  // namespace

Frame frame_along(const Vector3& direction) {
  Frame frame;
  for (int i = 0; i < 3; ++i) {
    if (!are_parallel(direction, Vector3::Unit(i))) continue;
    for (int j = 0; j < 3; ++j) frame.axes.col(j) = Vector3::Unit((i + 1 + j) % 3);
    return frame;
  }
  frame.axes = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), direction).toRotationMatrix();
  return frame;
}

Frame find_frame(const Model& model, const State& state) {
  for (const Vector3& axis : axis_candidates(model, state)) {
    const Frame frame = frame_along(axis);
    const Matrix3 to_frame = frame.axes.transpose();
    const Model there = turned(to_frame, model);
    if (allows_axis(there) && find_symmetry(there, turned(to_frame, state)).axisymmetric) return frame;
  }
  return {};
}

std::string axis_name(const Frame& frame) {
  const Vector3 axis = frame.axes.col(2);
  for (int i = 0; i < 3; ++i) {
    if (axis == Vector3::Unit(i)) return std::string(1, "xyz"[i]);
  }
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", axis.x(), axis.y(), axis.z());
}

Model turned(const Matrix3& rotation, Model model) {
  if (model.flow) model.flow->gradient = turned_tensor(rotation, model.flow->gradient);
  if (model.electric) model.electric->field = turned_vector(rotation, model.electric->field);
  for (auto& effect : model.effects) effect = effect->turned(rotation);
  return model;
}

State turned(const Matrix3& rotation, State state) {
  if (rotation.isIdentity(0.0)) return state;
  state.position = turned_vectors(rotation, state.position);
  state.transmembrane_potential = turned_scalar(rotation, state.transmembrane_potential);
  state.tension = turned_scalar(rotation, state.tension);
  state.area_strain = turned_scalar(rotation, state.area_strain);
  return state;
}

Fields turned(const Matrix3& rotation, Fields fields) {
  if (rotation.isIdentity(0.0)) return fields;
  for (Matrix* vectors : {&fields.velocity, &fields.force_bending, &fields.force_tension, &fields.force_electric}) {
    *vectors = turned_vectors(rotation, *vectors);
  }
  fields.tension = turned_scalar(rotation, fields.tension);
  fields.charge = turned_scalar(rotation, fields.charge);
  return fields;
}

}  // namespace vehd
