#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bie/sphere/exchange.hpp"
#include "bie/sphere/reflection.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Symmetries about the coordinate axes of a body with its parametrisation, x(g s) = g x(s), and of the forces and
/// fields on it. A map may also reverse the electric field; then V_m changes sign and forces do not.
struct Symmetry {
  bool axisymmetric = false;  ///< about z, without swirl
  /// Products of the mirrors x, y, z → −x, −y, −z under which everything is invariant, the identity included.
  std::vector<Reflection> reflections{Reflection{}};
  /// Sign of V_m under each reflection.
  std::vector<int> potential_signs{1};
  /// Rotations by 2π/fold about z are symmetries as well; 1 if there is none beyond the half turn of the reflections.
  int fold = 1;
  /// Which of several bodies are images of others. All other members describe each body by itself.
  Exchange exchange{};

  /// Whether each body by itself has any symmetry.
  [[nodiscard]] bool any() const { return axisymmetric || reflections.size() > 1 || fold > 1; }
  /// Number of images of a point in general position, itself included; not for axisymmetric bodies.
  [[nodiscard]] int group_order() const;
};

/// Coefficients that can be nonzero in fields on one membrane under its symmetries, and projection of fields onto their
/// symmetric part. Immutable; copies share their lists.
/// Accuracy: exact for reflections; means under rotations to rounding. Steps within the subspace agree with full ones
/// to 1e-9 (tests/stepping/state/symmetry_test.cpp, tests/stepping/state/fold_test.cpp)
class SymmetrySubspace {
 public:
  /// @param order  degree of the fields
  SymmetrySubspace(Symmetry symmetry, int order);

  [[nodiscard]] const Symmetry& symmetry() const { return symmetry_; }
  /// Number of all coefficients of a scalar, (order + 1)².
  [[nodiscard]] Index n_coefficients() const { return Index{order_ + 1} * (order_ + 1); }

  /// coefficient_index of the coefficients that can be nonzero in a symmetric scalar such as H or λ; ascending.
  [[nodiscard]] const std::vector<Index>& scalars() const { return lists_->scalars; }
  /// Counterpart of scalars() for fields that change sign with V_m: V_m, φ and the charges.
  [[nodiscard]] const std::vector<Index>& potentials() const { return lists_->potentials; }
  /// Positions in a column-major [n_coefficients x 3] of the entries of a vector field that mirrors and axisymmetry
  /// allow to be nonzero; ascending. Rotations by 2π/fold couple the components but exclude no position.
  [[nodiscard]] const std::vector<Index>& vectors() const { return lists_->vectors; }
  /// coefficient_index of all coefficients of a scalar in classes, each ascending. An operator that is invariant under
  /// the symmetries does not couple different classes.
  [[nodiscard]] const std::vector<std::vector<Index>>& scalar_classes() const { return lists_->scalar_classes; }

  /// Mean of a field and its images, coefficients, [n_coefficients]. It removes rounding errors that break a symmetry,
  /// which an instability would amplify.
  [[nodiscard]] Vector symmetric_scalar(const Vector& field) const;
  /// symmetric_scalar of a field that changes sign with V_m, [n_coefficients].
  [[nodiscard]] Vector symmetric_potential(const Vector& field) const;
  /// symmetric_scalar of a vector field, Cartesian components, [n_coefficients x 3].
  [[nodiscard]] Matrix symmetric_vector(const Matrix& field) const;

 private:
  struct Lists {
    std::vector<Index> scalars, potentials;
    std::array<std::vector<Index>, 3> components;  ///< per component, those that mirrors allow to be nonzero
    std::vector<Index> vectors;
    std::vector<std::vector<Index>> scalar_classes;
  };
  static Lists lists_of(const Symmetry& symmetry, int order);

  Symmetry symmetry_;
  int order_;
  std::shared_ptr<const Lists> lists_;
};

}  // namespace vehd
