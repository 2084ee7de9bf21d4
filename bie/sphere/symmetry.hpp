#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bie/sphere/exchange.hpp"
#include "bie/sphere/reflection.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Symmetries about the coordinate axes of a body with its parametrisation, x(g s) = g x(s), and of the forces and
/// fields on it. A field may also change its sign: V_m does then, forces do not.
struct Symmetry {
  bool axisymmetric = false;  ///< about z, without swirl
  /// Products of mirrors x, y, z → −x, −y, −z under which everything is its own image, the identity among them.
  std::vector<Reflection> reflections{Reflection{}};
  /// Sign of V_m under each reflection.
  std::vector<int> potential_signs{1};
  /// Turns by 2π/fold about z are symmetries as well; 1 where there is none beyond the half turn of the reflections.
  int fold = 1;
  /// Which of several bodies are images of others; all else is said of each body by itself.
  Exchange exchange{};

  /// Is there any symmetry of each body by itself?
  [[nodiscard]] bool any() const { return axisymmetric || reflections.size() > 1 || fold > 1; }
  /// Number of images that a point in general position has, itself included; not for axisymmetric ones.
  [[nodiscard]] int group_order() const;
};

/// Which coefficients of the fields on one membrane can differ from zero under its symmetries, and the part of a field
/// that is its own image. Immutable; copies share their lists.
/// Accuracy: exact for reflections; means under rotations to rounding. Steps within the subspace agree with full ones
/// to 1e-9 (tests/stepping/state/symmetry_test.cpp, tests/stepping/state/fold_test.cpp)
class SymmetrySubspace {
 public:
  /// @param order  degree of the fields
  SymmetrySubspace(Symmetry symmetry, int order);

  [[nodiscard]] const Symmetry& symmetry() const { return symmetry_; }
  /// Coefficients of a scalar, (order + 1)², whether they can differ from zero or not.
  [[nodiscard]] Index n_coefficients() const { return Index{order_ + 1} * (order_ + 1); }

  /// coefficient_index of the coefficients of a scalar that may differ from zero if it is its own image, as H and λ
  /// are; ascending.
  [[nodiscard]] const std::vector<Index>& scalars() const { return lists_->scalars; }
  /// scalars() of a field that takes the sign of V_m, as V_m, φ and the charges do.
  [[nodiscard]] const std::vector<Index>& potentials() const { return lists_->potentials; }
  /// Positions in a column-major [n_coefficients x 3] of what mirrors and the axis leave of a vector field; ascending.
  /// Turns relate its components to one another and leave no position out.
  [[nodiscard]] const std::vector<Index>& vectors() const { return lists_->vectors; }
  /// coefficient_index of all scalars in classes, each ascending: an operator that is its own image under the
  /// symmetries takes none to another.
  [[nodiscard]] const std::vector<std::vector<Index>>& scalar_classes() const { return lists_->scalar_classes; }

  /// Mean of a field and its images, coefficients, [n_coefficients]: an instability would amplify rounding errors that
  /// break a symmetry.
  [[nodiscard]] Vector symmetric_scalar(const Vector& field) const;
  /// See symmetric_scalar; of a field that takes the sign of V_m, [n_coefficients].
  [[nodiscard]] Vector symmetric_potential(const Vector& field) const;
  /// See symmetric_scalar; of the Cartesian components of a vector field, [n_coefficients x 3].
  [[nodiscard]] Matrix symmetric_vector(const Matrix& field) const;

 private:
  struct Lists {
    std::vector<Index> scalars, potentials;
    std::array<std::vector<Index>, 3> components;  ///< nonzero with the mirrors, of each component
    std::vector<Index> vectors;
    std::vector<std::vector<Index>> scalar_classes;
  };
  static Lists lists_of(const Symmetry& symmetry, int order);

  Symmetry symmetry_;
  int order_;
  std::shared_ptr<const Lists> lists_;
};

}  // namespace vehd
