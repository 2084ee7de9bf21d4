#include "bie/sphere/symmetry.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Coefficients of scalar fields with f(s) = sign · f(g s). A reflection changes only signs of coefficients. One that
/// changes sign under any reflection does so under half of the group, so that the mean over the group is zero.
std::vector<Index> kept_coefficients(const Symmetry& symmetry, const std::vector<int>& signs, int order) {
  std::vector<Index> result;
  for (int n = 0; n <= order; ++n) {
    for (int m = -n; m <= n; ++m) {
      bool kept = symmetry.axisymmetric ? m == 0 : m % symmetry.fold == 0;
      for (std::size_t g = 0; g < signs.size(); ++g) kept = kept && signs[g] * symmetry.reflections[g].parity(n, m) > 0;
      if (kept) result.push_back(coefficient_index(n, m));
    }
  }
  return result;
}

std::vector<int> even_signs(const Symmetry& symmetry) { return std::vector<int>(symmetry.reflections.size(), 1); }

/// Signs of one Cartesian component of a vector field.
std::vector<int> component_signs(const Symmetry& symmetry, int component) {
  std::vector<int> signs;
  for (const Reflection& g : symmetry.reflections) signs.push_back(g.sign(component));
  return signs;
}

/// The symmetry without rotations.
Symmetry reflections_of(Symmetry symmetry) {
  symmetry.axisymmetric = false;
  symmetry.fold = 1;
  return symmetry;
}

Vector restricted(const std::vector<Index>& entries, const Vector& field) {
  Vector result = Vector::Zero(field.size());
  for (const Index i : entries) result[i] = field[i];
  return result;
}

/// Mean of a vector field and its images under the rotations: it keeps the parts e^{imφ} of v_x + i v_y with m = 1
/// modulo the fold and those of v_z with m = 0 modulo the fold.
Matrix rotated_mean(int fold, const Matrix& field) {
  Matrix result = Matrix::Zero(field.rows(), 3);
  const auto is_multiple = [&](int m) { return m % fold == 0; };
  for (int n = 0; n <= order_of(field.rows()); ++n) {
    for (int m = 0; m <= n; ++m) {
      const Index cosine = coefficient_index(n, m), sine = coefficient_index(n, -m);
      if (is_multiple(m)) {
        result(cosine, 2) = field(cosine, 2);
        result(sine, 2) = field(sine, 2);
      }
      if (m == 0) continue;
      if (is_multiple(m - 1)) {
        const double real = 0.5 * (field(cosine, 0) + field(sine, 1));
        const double imaginary = 0.5 * (field(cosine, 1) - field(sine, 0));
        result(cosine, 0) += real;
        result(sine, 1) += real;
        result(cosine, 1) += imaginary;
        result(sine, 0) -= imaginary;
      }
      if (is_multiple(m + 1)) {
        const double real = 0.5 * (field(cosine, 0) - field(sine, 1));
        const double imaginary = 0.5 * (field(cosine, 1) + field(sine, 0));
        result(cosine, 0) += real;
        result(sine, 1) -= real;
        result(cosine, 1) += imaginary;
        result(sine, 0) += imaginary;
      }
    }
  }
  return result;
}

/// x = R(θ) cos φ, y = R(θ) sin φ, z = Z(θ).
Matrix axisymmetric_part(const Matrix& field) {
  Matrix result = Matrix::Zero(field.rows(), 3);
  for (int n = 0; n <= order_of(field.rows()); ++n) {
    result(coefficient_index(n, 0), 2) = field(coefficient_index(n, 0), 2);
    if (n == 0) continue;
    const double radial = 0.5 * (field(coefficient_index(n, 1), 0) + field(coefficient_index(n, -1), 1));
    result(coefficient_index(n, 1), 0) = radial;
    result(coefficient_index(n, -1), 1) = radial;
  }
  return result;
}

std::vector<std::vector<Index>> classes_of(const Symmetry& symmetry, int order) {
  // The key of a class: ±m modulo the fold (|m| if axisymmetric) and the signs under the reflections.
  std::map<std::vector<int>, std::vector<Index>> classes;
  std::vector<int> key;
  for (int n = 0; n <= order; ++n) {
    for (int m = -n; m <= n; ++m) {
      const int rest = std::abs(m) % symmetry.fold;
      key.assign(1, symmetry.axisymmetric ? std::abs(m) : std::min(rest, symmetry.fold - rest));
      for (const Reflection& g : symmetry.reflections) key.push_back(g.parity(n, m));
      classes[key].push_back(coefficient_index(n, m));
    }
  }
  std::vector<std::vector<Index>> result;
  for (auto& [known, indices] : classes) result.push_back(std::move(indices));
  return result;
}

}  // namespace

int Symmetry::group_order() const {
  const bool rotated_twice =
      fold % 2 == 0 && std::find(reflections.begin(), reflections.end(), Reflection{-1, -1, 1}) != reflections.end();
  return fold * static_cast<int>(reflections.size()) / (rotated_twice ? 2 : 1);
}

SymmetrySubspace::SymmetrySubspace(Symmetry symmetry, int order)
    : symmetry_(std::move(symmetry)),
      order_(order),
      lists_(std::make_shared<const Lists>(lists_of(symmetry_, order))) {}

SymmetrySubspace::Lists SymmetrySubspace::lists_of(const Symmetry& symmetry, int order) {
  Lists lists;
  lists.scalars = kept_coefficients(symmetry, even_signs(symmetry), order);
  lists.potentials = kept_coefficients(symmetry, symmetry.potential_signs, order);
  const Symmetry mirrors = reflections_of(symmetry);
  for (int component = 0; component < 3; ++component) {
    lists.components[component] = kept_coefficients(mirrors, component_signs(mirrors, component), order);
    for (const Index i : lists.components[component]) {
      const int n = degree_of(i);
      const auto m = static_cast<int>(i - coefficient_index(n, 0));
      const bool kept = !symmetry.axisymmetric || std::abs(m) <= 1;
      if (kept) lists.vectors.push_back(component * vehd::n_coefficients(order) + i);
    }
  }
  lists.scalar_classes = classes_of(symmetry, order);
  return lists;
}

Vector SymmetrySubspace::symmetric_scalar(const Vector& field) const { return restricted(lists_->scalars, field); }

Vector SymmetrySubspace::symmetric_potential(const Vector& field) const {
  return restricted(lists_->potentials, field);
}

Matrix SymmetrySubspace::symmetric_vector(const Matrix& field) const {
  Matrix result(field.rows(), 3);
  for (int i = 0; i < 3; ++i) result.col(i) = restricted(lists_->components[i], field.col(i));
  if (symmetry_.fold > 1) result = rotated_mean(symmetry_.fold, result);
  return symmetry_.axisymmetric ? axisymmetric_part(result) : result;
}

}  // namespace vehd
