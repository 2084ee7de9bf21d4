#include "bie/stepping/state/invariance.hpp"

#include <algorithm>

#include "bie/stepping/state/composition.hpp"

namespace vehd {

namespace {

constexpr double kRounding = 1e-12;

template <typename Difference, typename Field>
bool is_small(const Eigen::MatrixBase<Difference>& difference, const Eigen::MatrixBase<Field>& field) {
  return difference.cwiseAbs().maxCoeff() <= kRounding * field.cwiseAbs().maxCoeff();
}

std::vector<const Vector*> properties_of(const MembraneMaterial& material) {
  std::vector<const Vector*> properties;
  for_each_property(material, [&](const Vector& property) { properties.push_back(&property); });
  return properties;
}

bool are_same(const MembraneMaterial& image, const MembraneMaterial& material) {
  return std::ranges::equal(properties_of(image), properties_of(material), [](const Vector* a, const Vector* b) {
    return a->size() == b->size() && is_small(*a - *b, *b);
  });
}

}  // namespace

int potential_sign(const Model& model, const Reflection& g) {
  const auto effects = explicit_effects(model);
  const auto is_invariant = [&](const auto& effect) { return effect->is_invariant_under(g); };
  if (!std::all_of(effects.begin(), effects.end(), is_invariant)) return 0;
  if (!model.electric) return 1;
  const Vector3& field = model.electric->field;
  const Vector3 image(g.x * field.x(), g.y * field.y(), g.z * field.z());
  if (is_small(image - field, field)) return 1;
  return is_small(image + field, field) ? -1 : 0;
}

bool is_invariant_under_rotations(const Model& model) {
  const auto effects = explicit_effects(model);
  return (!model.electric || model.electric->field.head<2>().isZero(0.0)) &&
         std::all_of(effects.begin(), effects.end(),
                     [](const auto& effect) { return effect->is_invariant_under_rotations(); });
}

bool are_same(const SurfaceFields& image, const SurfaceFields& fields) {
  if (image.position.rows() != fields.position.rows()) return false;
  const Matrix shape = fields.position.bottomRows(fields.position.rows() - 1);
  if (!is_small(image.position - fields.position, shape)) return false;
  if ((image.area_strain - fields.area_strain).cwiseAbs().maxCoeff() > kRounding) return false;
  const Vector& potential = fields.transmembrane_potential;
  if (image.transmembrane_potential.size() != potential.size()) return false;
  if (potential.size() > 0 && !is_small(image.transmembrane_potential - potential, potential)) return false;
  return are_same(image.material, fields.material);
}

}  // namespace vehd
