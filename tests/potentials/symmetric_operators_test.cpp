#include <boost/test/unit_test.hpp>
#include <numeric>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(symmetric_operators)

namespace {

constexpr int kDegree = 8;

/// A symmetry group with its rotations and the number of longitudes they require.
struct Group {
  const char* name;
  Symmetry symmetry;
  int n_phi = 2 * kDegree + 2;
};

const Reflection kX{-1, 1, 1}, kY{1, -1, 1}, kZ{1, 1, -1}, kHalfTurn{-1, -1, 1}, kAcross{-1, 1, -1},
    kInversion{-1, -1, -1};

Symmetry group_of(std::vector<Reflection> reflections, int fold = 1) {
  Symmetry symmetry;
  symmetry.potential_signs.assign(reflections.size(), 1);
  symmetry.reflections = std::move(reflections);
  symmetry.fold = fold;
  return symmetry;
}

const std::vector<Group> kGroups{
    {"none", group_of({{}})},
    {"mirror x", group_of({{}, kX})},
    {"mirror y", group_of({{}, kY})},
    {"mirror z", group_of({{}, kZ})},
    {"half turn about z", group_of({{}, kHalfTurn})},
    {"half turn about y", group_of({{}, kAcross})},
    {"inversion", group_of({{}, kInversion})},
    {"shear", group_of({{}, kY, kAcross, kInversion})},
    {"mirrors x and y", group_of({{}, kX, kY, kHalfTurn})},
    {"all mirrors", group_of({{}, kX, kY, kZ, kHalfTurn, kAcross, {1, -1, -1}, kInversion})},
    {"three turns", group_of({{}}, 3), 18},
    {"five turns and mirror y", group_of({{}, kY}, 5), 20},
    {"four turns", group_of({{}, kHalfTurn}, 4), 20},
    {"six turns and inversion", group_of({{}, kHalfTurn, kZ, kInversion}, 6), 18}};

/// Largest differences between operators on symmetric fields and the full ones; for the Laplace layers on any density.
void check_against_full(const SphereTransform& transform, const SymmetrySubspace& subspace, int fold,
                        const LayerSelection& everything) {
  const RotatedQuadrature quadrature = make_rotated_quadrature(transform.grid(), 1.15);
  const Matrix position = subspace.symmetric_vector(asymmetric_shape(kDegree));
  Instruments of_all, of_symmetric;
  const LayerOperators all = assemble_layer_operators(quadrature, transform, position, everything, of_all);
  const LayerOperators symmetric =
      assemble_symmetric_operators(quadrature, transform, position, everything, of_symmetric, subspace, fold);
  const Matrix random = random_coefficients(kDegree, 3, 71);
  const Matrix density = subspace.symmetric_vector(random);
  for (const auto layer : kVectorLayers) {
    BOOST_TEST(max_difference((symmetric.*layer).apply(density), (all.*layer).apply(density)) < 1e-12);
    const std::vector<Index> entries = subspace.vectors();
    BOOST_TEST(
        max_difference((symmetric.*layer).between(n_coefficients(kDegree), entries) * density.reshaped()(entries),
                       (all.*layer).apply(density).reshaped()(entries)) < 1e-12);
  }
  Matrix scalars = random;
  if (subspace.symmetry().axisymmetric) {
    for (int component = 0; component < 3; ++component) {
      for (Index i = 0; i < scalars.rows(); ++i) {
        const int m = static_cast<int>(i - coefficient_index(degree_of(i), 0));
        if (std::abs(m) > 1) scalars(i, component) = 0.0;
      }
    }
  }
  for (const auto layer : kScalarLayers) {
    BOOST_TEST(max_difference((symmetric.*layer).apply(scalars), (all.*layer).apply(scalars)) < 1e-12);
  }
  // Stokes layers alone need fewer kernels and are assembled by a different code path.
  const LayerSelection stokes{.stokes_single = true, .stokes_double = true, .plain = everything.plain};
  const LayerOperators alone =
      assemble_symmetric_operators(quadrature, transform, position, stokes, of_symmetric, subspace, fold);
  BOOST_TEST(max_difference(alone.stokes_single.apply(density), all.stokes_single.apply(density)) < 1e-12);
  BOOST_TEST(max_difference(alone.stokes_double.apply(density), all.stokes_double.apply(density)) < 1e-12);
}

void check_against_full(const SphereTransform& transform, const SymmetrySubspace& subspace, int fold) {
  for (const LayerSelection& everything : kEveryKernel) check_against_full(transform, subspace, fold, everything);
}

}  // namespace

BOOST_AUTO_TEST_CASE(they_are_the_full_operators_on_symmetric_fields) {
  for (const Group& group : kGroups) {
    BOOST_TEST_CONTEXT(group.name) {
      const SphereTransform transform(kDegree, make_grid(kDegree, group.n_phi));
      check_against_full(transform, {group.symmetry, kDegree}, group.symmetry.fold);
    }
  }
}

BOOST_AUTO_TEST_CASE(they_are_the_full_operators_on_axisymmetric_fields) {
  for (const bool mirrored : {false, true}) {
    Symmetry symmetry = mirrored ? group_of({{}, kX, kY, kZ, kHalfTurn, kAcross, {1, -1, -1}, kInversion})
                                 : group_of({{}, kX, kY, kHalfTurn});
    symmetry.axisymmetric = true;
    check_against_full({kDegree, make_grid(kDegree, 4), 1}, {symmetry, kDegree}, 4);
  }
}

BOOST_AUTO_TEST_CASE(stokes_matrix_shrinks_with_the_square_of_the_group) {
  const SphereTransform transform(kDegree, make_grid(kDegree));
  const RotatedQuadrature quadrature = make_rotated_quadrature(transform.grid(), 1.15);
  const SymmetrySubspace subspace(kGroups[7].symmetry, kDegree);
  const Matrix position = subspace.symmetric_vector(asymmetric_shape(kDegree));
  Instruments instruments;
  const auto symmetric =
      assemble_symmetric_operators(quadrature, transform, position, kStokesLayer, instruments, subspace, 1);
  std::vector<Index> all(3 * n_coefficients(kDegree));
  std::iota(all.begin(), all.end(), 0);
  // Entries that the operator does not have are zero here.
  const Matrix matrix = symmetric.stokes_single.between(n_coefficients(kDegree), all);
  BOOST_TEST((matrix.array() != 0.0).count() < matrix.size() / 12);
}

BOOST_AUTO_TEST_SUITE_END()
