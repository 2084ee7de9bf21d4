#include "bie/stepping/symmetry.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/composition.hpp"

namespace vehd {

namespace {

constexpr double kRounding = 1e-12;

std::vector<int> even_signs(const Symmetry& symmetry) { return std::vector<int>(symmetry.reflections.size(), 1); }

/// Coefficients of scalar fields with f = sign · f(g s): an image changes coefficients in sign only, and those that
/// change under one image of the group change under half of them.
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

/// Mean of a scalar field and its images, sign · f(g s).
Vector symmetric_scalar(const Symmetry& symmetry, const std::vector<int>& signs, const Vector& field) {
  Vector result = Vector::Zero(field.size());
  for (const Index i : kept_coefficients(symmetry, signs, order_of(field.size()))) result[i] = field[i];
  return result;
}

/// Mean of a vector field and its images under the turns: of v_x + i v_y it has the part e^{imφ}, m = 1 modulo the
/// fold, of v_z that with m = 0 modulo the fold.
Matrix turned_mean(int fold, const Matrix& field) {
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

/// Mean of a vector field and its images, g⁻¹ v(g s).
Matrix symmetric_vector(const Symmetry& symmetry, const Matrix& field) {
  Matrix result(field.rows(), 3);
  Symmetry images = symmetry;
  images.axisymmetric = false;
  images.fold = 1;
  for (int i = 0; i < 3; ++i) {
    std::vector<int> signs;
    for (const Reflection& g : symmetry.reflections) signs.push_back(g.sign(i));
    result.col(i) = symmetric_scalar(images, signs, field.col(i));
  }
  if (symmetry.fold > 1) result = turned_mean(symmetry.fold, result);
  if (!symmetry.axisymmetric) return result;
  // x = R(θ) cos φ, y = R(θ) sin φ, z = Z(θ).
  Matrix axisymmetric = Matrix::Zero(field.rows(), 3);
  for (int n = 0; n <= order_of(field.rows()); ++n) {
    axisymmetric(coefficient_index(n, 0), 2) = result(coefficient_index(n, 0), 2);
    if (n == 0) continue;
    const double radial = 0.5 * (result(coefficient_index(n, 1), 0) + result(coefficient_index(n, -1), 1));
    axisymmetric(coefficient_index(n, 1), 0) = radial;
    axisymmetric(coefficient_index(n, -1), 1) = radial;
  }
  return axisymmetric;
}

template <typename Difference, typename Field>
bool is_small(const Eigen::MatrixBase<Difference>& difference, const Eigen::MatrixBase<Field>& field) {
  return difference.cwiseAbs().maxCoeff() <= kRounding * field.cwiseAbs().maxCoeff();
}

/// Does the state equal its symmetric part?
bool has(const Symmetry& symmetry, const State& state) {
  const State part = symmetric_part(symmetry, state);
  const Matrix shape = state.position.bottomRows(state.position.rows() - 1);
  if (!is_small(part.position - state.position, shape)) return false;
  if ((part.area_strain - state.area_strain).cwiseAbs().maxCoeff() > kRounding) return false;
  const Vector& potential = state.transmembrane_potential;
  return potential.size() == 0 || is_small(part.transmembrane_potential - potential, potential);
}

/// Sign of g E = ± E, or 0 where neither holds.
int field_sign(const Model& model, const Reflection& g) {
  if (!model.electric) return 1;
  const Vector3& field = model.electric->field;
  const Vector3 image(g.x * field.x(), g.y * field.y(), g.z * field.z());
  if (is_small(image - field, field)) return 1;
  return is_small(image + field, field) ? -1 : 0;
}

/// The largest number of equal turns about z, at least three, under which the scene is its own image; 1 if there is
/// none. Beyond 2p + 2 it would not save anything.
int find_fold(const Model& model, const State& state) {
  const auto effects = explicit_effects(model);
  const auto allows_turns = [](const auto& effect) { return effect->allows_turns(); };
  if (model.electric && !model.electric->field.head<2>().isZero(0.0)) return 1;
  if (!std::all_of(effects.begin(), effects.end(), allows_turns)) return 1;
  for (int fold = 2 * order_of(state.position.rows()) + 2; fold > 2; --fold) {
    Symmetry turns;
    turns.fold = fold;
    if (has(turns, state)) return fold;
  }
  return 1;
}

}  // namespace

int Symmetry::group_order() const {
  const bool turned_twice =
      fold % 2 == 0 && std::find(reflections.begin(), reflections.end(), Reflection{-1, -1, 1}) != reflections.end();
  return fold * static_cast<int>(reflections.size()) / (turned_twice ? 2 : 1);
}

std::vector<Index> even_coefficients(const Symmetry& symmetry, int order) {
  return kept_coefficients(symmetry, even_signs(symmetry), order);
}

State symmetric_part(const Symmetry& symmetry, State state) {
  if (!symmetry.any()) return state;
  const std::vector<int> even = even_signs(symmetry);
  state.position = symmetric_vector(symmetry, state.position);
  state.area_strain = symmetric_scalar(symmetry, even, state.area_strain);
  if (state.tension.size() > 0) state.tension = symmetric_scalar(symmetry, even, state.tension);
  if (state.transmembrane_potential.size() > 0) {
    state.transmembrane_potential = symmetric_scalar(symmetry, symmetry.potential_signs, state.transmembrane_potential);
  }
  return state;
}

Symmetry find_symmetry(const Model& model, const State& state) {
  Symmetry result;
  const auto effects = explicit_effects(model);
  for (int bits = 1; bits < 8; ++bits) {
    const Reflection g{bits & 1 ? -1 : 1, bits & 2 ? -1 : 1, bits & 4 ? -1 : 1};
    const int sign = field_sign(model, g);
    const Symmetry single{false, {Reflection{}, g}, {1, sign}};
    const auto allows = [&](const auto& effect) { return effect->allows(g); };
    if (sign == 0 || !std::all_of(effects.begin(), effects.end(), allows) || !has(single, state)) continue;
    result.reflections.push_back(g);
    result.potential_signs.push_back(sign);
  }
  Symmetry axis;
  axis.axisymmetric = true;
  const bool field_allows = !model.electric || (model.electric->field.x() == 0.0 && model.electric->field.y() == 0.0);
  const auto allows_axis = [](const auto& effect) { return effect->allows_axis(); };
  result.axisymmetric = field_allows && std::all_of(effects.begin(), effects.end(), allows_axis) && has(axis, state);
  if (!result.axisymmetric) result.fold = find_fold(model, state);
  return result;
}

std::string symmetry_text(const Symmetry& symmetry, const std::array<std::string, 3>& axes) {
  std::vector<std::string> names;
  if (symmetry.axisymmetric) names.push_back("axisymmetric about " + axes[2]);
  if (symmetry.fold > 1) names.push_back(fmt::format("{}-fold about {}", symmetry.fold, axes[2]));
  for (const Reflection& g : symmetry.reflections) {
    const bool about_z = symmetry.axisymmetric && g.z > 0;
    const bool in_fold = symmetry.fold > 1 && g == Reflection{-1, -1, 1};
    if (g == Reflection{} || about_z || in_fold) continue;
    std::vector<std::string> turned;
    for (int i = 0; i < 3; ++i) {
      if (g.sign(i) < 0) turned.push_back(axes[static_cast<std::size_t>(i)]);
    }
    if (symmetry.axisymmetric && turned.size() > 1) continue;
    if (turned.size() == 3) {
      names.emplace_back("inversion");
    } else if (turned.size() == 2) {
      names.push_back("half turn about " + (g.x > 0 ? axes[0] : g.y > 0 ? axes[1] : axes[2]));
    } else {
      names.push_back("mirror " + turned[0]);
    }
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace vehd
