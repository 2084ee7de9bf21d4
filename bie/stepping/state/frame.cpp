#include "bie/stepping/state/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bie/physics/rotated.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/principal_axes.hpp"
#include "bie/sphere/rotation.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/state/symmetry.hpp"

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
  if (model.electric) {
    model.electric->field = rotated_vector(rotation, model.electric->field);
    model.electric->direction = rotated_vector(rotation, model.electric->direction);
  }
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
    // Recycled subspaces hold coefficients in the former axes, with the former symmetry.
    vesicle.recycled = {};
  }
  return without_past(std::move(state));
}

Fields rotated(const Matrix3& rotation, Fields fields) {
  if (rotation.isIdentity(0.0)) return fields;
  for (VesicleFields& vesicle : fields.vesicles) turn(vesicle, rotation);
  return fields;
}

namespace {

/// Tolerance of angles, and of distances over the size of a vesicle.
constexpr double kSamePlace = 1e-12;

bool are_parallel(const Vector3& a, const Vector3& b) { return a.cross(b).norm() <= kSamePlace * a.norm() * b.norm(); }

/// Unit vectors, no two of them parallel; coordinate axes come first, because nothing is rounded there.
std::vector<Vector3> axis_candidates(const Model& model, const State& state) {
  std::vector<Vector3> result{Vector3::UnitZ(), Vector3::UnitX(), Vector3::UnitY()};
  const auto add = [&](const Vector3& axis) {
    if (!(axis.norm() > 0.0)) return;
    const auto parallel = [&](const Vector3& known) { return are_parallel(known, axis); };
    if (std::none_of(result.begin(), result.end(), parallel)) result.push_back(axis.normalized());
  };
  for (const MadeEffect& effect : effects_on_all(model)) {
    for (const Vector3& axis : effect->axis_candidates()) add(axis);
  }
  for (const VesicleState& vesicle : state.vesicles) {
    // ∫ x xᵀ over the parameter sphere has the axes of the shape.
    const Matrix shape = vesicle.position.bottomRows(vesicle.position.rows() - 1);
    const Matrix3 axes = principal_axes(shape.transpose() * shape).directions;
    for (int i = 0; i < 3; ++i) add(axes.col(i));
    // Patterns with one pole, such as a cap, point along their harmonics of degree 1.
    for_each_property(vesicle.material, [&](const Vector& property) {
      const Vector3 side(property[coefficient_index(1, 1)], property[coefficient_index(1, -1)],
                         property[coefficient_index(1, 0)]);
      if (side.norm() > kSamePlace * property.norm()) add(side);
    });
  }
  return result;
}

bool is_translation_invariant(const Model& model) {
  return std::ranges::all_of(effects_on_all(model),
                             [](const MadeEffect& effect) { return effect->is_translation_invariant(); });
}

/// Mean over the parameter spheres.
Vector3 mean_position(const State& state) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const VesicleState& vesicle : state.vesicles) sum += vesicle.position.row(0);
  return sum / (static_cast<double>(state.vesicles.size()) * coefficient_of_one);
}

/// The origin of the laboratory and, if the effects are the same everywhere, the mean position.
std::vector<Vector3> origin_candidates(const Model& model, const State& state) {
  std::vector<Vector3> result{Vector3::Zero()};
  const auto is_away = [](const VesicleState& vesicle) {
    const double size = vesicle.position.bottomRows(vesicle.position.rows() - 1).norm();
    return vesicle.position.row(0).norm() > kSamePlace * size;
  };
  if (is_translation_invariant(model) && std::any_of(state.vesicles.begin(), state.vesicles.end(), is_away)) {
    result.push_back(mean_position(state));
  }
  return result;
}

/// Measure of the work that a symmetry saves; zero if it does not justify leaving the axes of the laboratory.
double worth(const Symmetry& symmetry, bool rotated, std::size_t n_vesicles) {
  constexpr double kAxis = 1e6;
  const double of_exchange =
      static_cast<double>(n_vesicles) / static_cast<double>(symmetry.exchange.n_originals(n_vesicles));
  if (symmetry.axisymmetric) return kAxis + static_cast<double>(symmetry.reflections.size()) * of_exchange;
  return rotated && symmetry.fold == 1 && symmetry.exchange.fold() == 1 ? 0.0 : symmetry.group_order() * of_exchange;
}

/// The origin as coefficients of degree 0.
Eigen::RowVector3d shift_of(const Frame& frame) { return frame.origin.transpose() * coefficient_of_one; }

/// "x", "y", "z" or its components.
std::string axis_name(const Vector3& axis) {
  for (int i = 0; i < 3; ++i) {
    if (axis == Vector3::Unit(i)) return std::string(1, "xyz"[i]);
  }
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", axis.x(), axis.y(), axis.z());
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
  const std::vector<Vector3> axes = axis_candidates(model, state);
  Frame best;
  double most = 0.0;
  for (const Vector3& origin : origin_candidates(model, state)) {
    for (const Vector3& axis : axes) {
      Frame frame = frame_along(axis);
      frame.origin = origin;
      const Model there = in_frame(frame, model);
      if (frame.is_rotated() && !is_invariant_under_rotations(there)) continue;
      const Symmetry symmetry = find_symmetry(there, in_frame(frame, state));
      const double here = worth(symmetry, frame.is_rotated(), state.vesicles.size());
      if (here > most) {
        best = frame;
        most = here;
      }
      if (symmetry.axisymmetric) break;
    }
  }
  return best;
}

std::string symmetry_text(const Symmetry& symmetry, const Frame& frame) {
  std::array<std::string, 3> names;
  for (int i = 0; i < 3; ++i) names[static_cast<std::size_t>(i)] = axis_name(frame.axes.col(i));
  const std::string text = symmetry_text(symmetry, names);
  if ((!symmetry.any() && !symmetry.exchange.any()) || frame.origin.isZero(0.0)) return text;
  return fmt::format("{}, through ({:.3g}, {:.3g}, {:.3g})", text, frame.origin.x(), frame.origin.y(),
                     frame.origin.z());
}

Model in_frame(const Frame& frame, Model of_laboratory) {
  if (of_laboratory.wall) of_laboratory.wall->point -= frame.origin;
  return rotated(frame.axes.transpose(), std::move(of_laboratory));
}

State in_frame(const Frame& frame, State of_laboratory) {
  for (VesicleState& vesicle : of_laboratory.vesicles) {
    vesicle.position.row(0) -= shift_of(frame);
    if (vesicle.crossing) vesicle.crossing->place -= frame.origin;
  }
  return rotated(frame.axes.transpose(), std::move(of_laboratory));
}

State in_laboratory(const Frame& frame, State of_frame) {
  State result = rotated(frame.axes, std::move(of_frame));
  for (VesicleState& vesicle : result.vesicles) {
    vesicle.position.row(0) += shift_of(frame);
    if (vesicle.crossing) vesicle.crossing->place += frame.origin;
  }
  return result;
}

Fields in_laboratory(const Frame& frame, const Fields& of_frame) { return rotated(frame.axes, of_frame); }

}  // namespace vehd
