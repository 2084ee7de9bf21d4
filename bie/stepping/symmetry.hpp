#pragma once

#include <array>
#include <string>
#include <vector>

#include "bie/sphere/reflection.hpp"
#include "bie/stepping/model.hpp"
#include "bie/stepping/state.hpp"

namespace vehd {

/// Symmetries about the coordinate axes that a scene has at its start and keeps: of the shape with its
/// parametrisation, x(g s) = g x(s), of the flow, and of the field, which may also change its sign (V_m does then,
/// forces do not).
struct Symmetry {
  bool axisymmetric = false;  ///< about z, without swirl
  /// Products of mirrors x, y, z → −x, −y, −z under which the scene is its own image, the identity among them.
  std::vector<Reflection> reflections{Reflection{}};
  /// Sign of V_m under each reflection.
  std::vector<int> potential_signs{1};

  /// Turns by 2π/fold about z are symmetries as well; 1 where there is none beyond the half turn of the reflections.
  int fold = 1;

  [[nodiscard]] bool any() const { return axisymmetric || reflections.size() > 1 || fold > 1; }
  /// Number of images that a point in general position has, itself included; not for axisymmetric ones.
  [[nodiscard]] int group_order() const;
};

/// What `auto` finds. Deviations within 1e-12 of the size count as rounding.
Symmetry find_symmetry(const Model& model, const State& state);

/// In words: "axisymmetric about z, mirror z", "mirror y, half turn about y, inversion", "none".
/// @param axes  their names; the third carries the poles
std::string symmetry_text(const Symmetry& symmetry, const std::array<std::string, 3>& axes = {"x", "y", "z"});

/// Which coefficients of a scalar that is its own image, as H and λ are, can differ from zero; ascending.
std::vector<Index> even_coefficients(const Symmetry& symmetry, int order);

/// The symmetric part of a state. Rounding breaks a symmetry and an instability would feed on that.
State symmetric_part(const Symmetry& symmetry, State state);

}  // namespace vehd
