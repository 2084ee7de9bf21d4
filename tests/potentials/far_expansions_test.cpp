#include "bie/potentials/far_expansions.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/geometry/surface.hpp"
#include "bie/potentials/pair_layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(far_expansions)

namespace {

constexpr int kOrder = 8;

/// Shapes without symmetry, of different sizes; the fourth is near the first, the last as near as expansions allow.
std::vector<Matrix> shapes() {
  const Matrix shape = asymmetric_shape(kOrder);
  return {shape, translated(0.6 * shape * general_rotation().transpose(), {6.0, -5.0, 4.0}),
          translated(shape * general_rotation(), {-9.0, 1.0, 6.0}), translated(shape, {3.1, 0.4, 0.2}),
          translated(shape, {-2.3, 5.3, -1.2})};
}

std::vector<ExpandedMembrane> expanded(const std::vector<Matrix>& positions, double length = 1.0) {
  const SphereTransform nodes(kOrder, make_grid(kOrder));
  std::vector<ExpandedMembrane> result;
  for (const Matrix& position : positions) {
    const Surface s = make_surface(nodes, length * position);
    result.push_back({length * position, s.position, s.normal});
  }
  return result;
}

/// Direct sum of `layer` over all far membranes at the points.
template <class Layer>
std::vector<Matrix> direct(const std::vector<ExpandedMembrane>& all, const FarExpansions& far, const Layer& layer) {
  std::vector<Matrix> values(all.size());
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = 0; b < all.size(); ++b) {
      if (a == b || !far.is_far(a, b)) continue;
      Instruments instruments;
      SharedTransforms transforms;
      const PairLayers pair(all[b].position, all[a].points, all[a].normals, {true, true, true, true, true, true},
                            {.tolerance = 1e-12}, transforms, instruments);
      const Matrix one = layer(pair, b);
      values[a] = values[a].size() > 0 ? Matrix(values[a] + one) : one;
    }
  }
  return values;
}

double largest_error(const std::vector<Matrix>& found, const std::vector<Matrix>& exact) {
  double error = 0.0;
  for (std::size_t a = 0; a < found.size(); ++a) error = std::max(error, relative_difference(found[a], exact[a]));
  return error;
}

}  // namespace

BOOST_AUTO_TEST_CASE(agree_with_direct_sums) {
  const std::vector<ExpandedMembrane> all = expanded(shapes());
  std::vector<Matrix> scalars, vectors;
  for (unsigned b = 0; b < all.size(); ++b) {
    vectors.push_back(smooth_coefficients(kOrder, 5, 3, 40 + b));
    scalars.emplace_back(vectors.back().col(0));
  }
  for (const double tolerance : {1e-5, 1e-9}) {
    SharedTransforms transforms;
    const FarExpansions far(all, tolerance, transforms);
    BOOST_TEST(!far.is_far(0, 3));
    BOOST_TEST(far.is_far(1, 2));
    BOOST_TEST(far.is_far(0, 4));
    const auto check = [&](const std::vector<Matrix>& found, auto layer) {
      const double error = largest_error(found, direct(all, far, layer));
      BOOST_TEST(error < tolerance, error);
    };
    for (std::size_t i = 0; i < n_pair_layers; ++i) {
      const auto layer = static_cast<PairLayer>(i);
      // Images in a plane are summed directly.
      if (is_no_slip(layer)) continue;
      const std::vector<Matrix>& densities = is_stokes(layer) ? vectors : scalars;
      check(far.apply(layer, densities),
            [&](const PairLayers& pair, std::size_t b) { return pair.apply(layer, densities[b]); });
    }
  }
}

BOOST_AUTO_TEST_CASE(are_independent_of_the_unit_of_length) {
  const std::vector<Matrix> positions = shapes();
  constexpr double kLength = 0x1p-20;
  SharedTransforms transforms;
  const FarExpansions far(expanded(positions), 1e-7, transforms);
  const FarExpansions small(expanded(positions, kLength), 1e-7, transforms);
  std::vector<Matrix> vectors;
  for (unsigned b = 0; b < positions.size(); ++b) vectors.push_back(smooth_coefficients(kOrder, 5, 3, 40 + b));
  const std::vector<Matrix> one = far.apply(PairLayer::stokes_single, vectors),
                            other = small.apply(PairLayer::stokes_single, vectors);
  for (std::size_t a = 0; a < positions.size(); ++a) BOOST_TEST((one[a] / kLength - other[a]).norm() == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
