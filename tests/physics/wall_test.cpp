#include "bie/physics/wall.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/physics/volume_fields.hpp"
#include "tests/support/beside_wall.hpp"
#include "tests/support/fields.hpp"
#include "tests/support/point_force.hpp"
#include "tests/support/several.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(wall)

namespace {

constexpr PairSelection kAllPairs{true, true, true, true, true, true};

Interaction interaction_of(const Space& space, const std::vector<Matrix>& positions,
                           const std::optional<Wall>& wall = {}, const Symmetry& symmetry = {}) {
  std::vector<InteractingMembrane> all;
  for (const Matrix& position : positions) all.push_back({position, space.coarse, kAllPairs, symmetry});
  Instruments instruments;
  return {all, {}, instruments, {}, {}, {}, wall};
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_nearest_point_of_an_ellipsoid_is_found_between_nodes) {
  const Wall wall = oblique_wall(WallFlow::no_slip, WallField::none);
  const Vector3 axes(0.7, 0.9, 1.4), centre(0.5, 0.2, 3.0);
  const WallGap found = nearest_to_wall(wall, translated(ellipsoid(24, axes), centre));
  const Vector3 lowest = centre - axes.cwiseAbs2().cwiseProduct(wall.normal) / axes.cwiseProduct(wall.normal).norm();
  BOOST_TEST(std::abs(found.distance - wall.height(lowest)) < 1e-12);
  BOOST_TEST((found.place - lowest).norm() < 1e-7);
}

// Mirrors that preserve the wall, rotations about its normal, all rotations. On a grid of 9 x 18 nodes mirrors reduce
// the targets to 5 x 10: nodes in a mirror plane are their own images.
BOOST_AUTO_TEST_CASE(layers_at_nodes_that_symmetries_relate_follow_from_one_of_them) {
  constexpr int kOrder = 8;
  const Space space(kOrder);
  const Symmetry mirrors{.reflections = {{}, {1, -1, 1}, {1, 1, -1}, {1, -1, -1}}, .potential_signs = {1, 1, -1, -1}};
  const Symmetry turns{.fold = 3};
  const Symmetry all_turns{
      .axisymmetric = true, .reflections = {{}, {-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}, .potential_signs = {1, 1, 1, 1}};
  for (const auto& [symmetry, normal, share] :
       {std::tuple{mirrors, Vector3::UnitX().eval(), 0.31}, std::tuple{turns, Vector3::UnitZ().eval(), 0.34},
        std::tuple{all_turns, Vector3::UnitZ().eval(), 0.07}}) {
    const Wall wall{Vector3::Zero(), normal, WallFlow::no_slip, WallField::electrode};
    const SymmetrySubspace subspace(symmetry, kOrder);
    const Matrix position = at_gap(wall, subspace.symmetric_vector(asymmetric_shape(kOrder)), 0.1);
    const std::vector<Matrix> vectors{subspace.symmetric_vector(smooth_coefficients(kOrder, 5, 3, 70))};
    const std::vector<Vector> scalars{subspace.symmetric_potential(smooth_coefficients(kOrder, 5, 1, 71))};
    const Interaction reduced = interaction_of(space, {position}, wall, symmetry),
                      full = interaction_of(space, {position}, wall);
    const auto n_targets = [](const Interaction& one) {
      return static_cast<double>(one.counts().far + one.counts().near);
    };
    BOOST_TEST(n_targets(reduced) <= share * n_targets(full));
    for (const auto layer : {&Interaction::weighted_single_flux, &Interaction::weighted_double_flux,
                             &Interaction::single_potential, &Interaction::double_potential}) {
      BOOST_TEST(relative_difference((reduced.*layer)(scalars)[0], (full.*layer)(scalars)[0]) < 1e-9);
    }
    for (const auto layer : {&Interaction::stokes_single, &Interaction::stokes_double}) {
      BOOST_TEST(relative_difference((reduced.*layer)(vectors)[0], (full.*layer)(vectors)[0]) < 1e-9);
    }
  }
}

// Beside an insulating wall, an electrode or a stress-free wall all layers equal those of two mirrored membranes.
BOOST_AUTO_TEST_CASE(layers_are_those_of_mirrored_membranes) {
  constexpr int kOrder = 10;
  const Space space(kOrder);
  for (const WallField field : {WallField::insulating, WallField::electrode}) {
    const Wall wall = oblique_wall(WallFlow::stress_free, field);
    const MirrorImage mirror{wall};
    const double sign = field == WallField::electrode ? -1.0 : 1.0;
    for (const double gap : {1e-3, 0.5}) {
      std::vector<Matrix> positions{at_gap(wall, asymmetric_shape(kOrder), gap)};
      positions.push_back(translated(positions[0], Vector3(3.0, 0.4, 1.5)));
      const std::size_t n = positions.size();
      std::vector<Vector> scalars, all_scalars;
      std::vector<Matrix> vectors, all_vectors, all_positions = positions;
      for (unsigned a = 0; a < n; ++a) {
        vectors.push_back(smooth_coefficients(kOrder, 5, 3, 70 + a));
        scalars.emplace_back(vectors.back().col(1));
      }
      all_scalars = scalars;
      all_vectors = vectors;
      for (std::size_t a = 0; a < n; ++a) {
        all_positions.push_back(mirror.position(positions[a]));
        all_scalars.emplace_back(sign * mirror.scalar(scalars[a]));
        all_vectors.push_back(mirror.vector(vectors[a]));
      }
      const Interaction beside = interaction_of(space, positions, wall), all = interaction_of(space, all_positions);
      for (const auto layer : {&Interaction::weighted_single_flux, &Interaction::weighted_double_flux,
                               &Interaction::single_potential, &Interaction::double_potential}) {
        const std::vector<Vector> found = (beside.*layer)(scalars), expected = (all.*layer)(all_scalars);
        for (std::size_t a = 0; a < n; ++a)
          BOOST_TEST(relative_difference(found[a], expected[a]) < 1e-9, "gap " << gap);
      }
      for (const auto layer : {&Interaction::stokes_single, &Interaction::stokes_double}) {
        const std::vector<Matrix> found = (beside.*layer)(vectors), expected = (all.*layer)(all_vectors);
        for (std::size_t a = 0; a < n; ++a)
          BOOST_TEST(relative_difference(found[a], expected[a]) < 1e-9, "gap " << gap);
      }
    }
  }
}

// For a flow u, regular within the membrane, with traction t, S[t] − D[u] vanishes outside. The same combination of its
// images vanishes on the membrane, for every wall.
BOOST_AUTO_TEST_CASE(images_without_slip_obey_greens_identity) {
  constexpr int kOrder = 20;
  const Space space(kOrder);
  const Wall wall = oblique_wall(WallFlow::no_slip, WallField::none);
  for (const double gap : {1e-3, 0.1, 2.0}) {
    const Matrix position = at_gap(wall, asymmetric_shape(kOrder), gap);
    const Membrane membrane = make_membrane(space, position, {});
    const Vector3 centre = position.row(0).transpose() / std::sqrt(4.0 * std::numbers::pi);
    const PointForce outside = point_force(membrane.surface, centre + 4.0 * wall.normal, {0.3, -0.7, 0.4});
    const Interaction interaction = interaction_of(space, {position}, wall);
    const Matrix single = interaction.stokes_single({membrane.weighted(outside.traction)})[0];
    const Matrix jump = interaction.stokes_double({space.fine.analyze(outside.velocity)})[0];
    BOOST_TEST(relative_difference(single, jump) < 1e-9, "gap " << gap);
  }
}

BOOST_AUTO_TEST_CASE(the_fluid_rests_on_a_wall_without_slip_and_does_not_cross_a_free_one) {
  constexpr int kOrder = 12;
  Instruments instruments;
  for (const WallFlow kind : {WallFlow::no_slip, WallFlow::stress_free}) {
    const Wall wall = oblique_wall(kind, WallField::none);
    const Matrix position = at_gap(wall, asymmetric_shape(kOrder), 0.05);
    VelocitySources sources{2.0, {}, smooth_coefficients(kOrder, 5, 3, 3), 4.0, smooth_coefficients(kOrder, 5, 3, 4)};
    sources.wall = wall;
    Matrix points(5, 3);
    points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, -3, 0, 0.3, 0.2, 0;
    for (Index i = 0; i < points.rows(); ++i) {
      const Vector3 x = points.row(i).transpose();
      points.row(i) = (x - wall.height(x) * wall.normal).transpose();
    }
    const Matrix flow = velocity_at(points, position, sources, {}, instruments).velocity;
    sources.wall.reset();
    const double size = velocity_at(points, position, sources, {}, instruments).velocity.norm();
    const double left = kind == WallFlow::no_slip ? flow.norm() : (flow * wall.normal).norm();
    BOOST_TEST(left < 1e-9 * size);
  }
}

BOOST_AUTO_TEST_CASE(no_current_crosses_an_insulating_wall_and_an_electrode_has_one_potential) {
  constexpr int kOrder = 12;
  Instruments instruments;
  for (const WallField kind : {WallField::insulating, WallField::electrode}) {
    const Wall wall = oblique_wall(WallFlow::none, kind);
    const Matrix position = at_gap(wall, asymmetric_shape(kOrder), 0.05);
    const Vector3 along = wall.normal.unitOrthogonal();
    const Matrix fields = smooth_coefficients(kOrder, 5, 2, 3);
    const PotentialSources sources{kind == WallField::electrode ? wall.normal : along, fields.col(0), fields.col(1),
                                   wall};
    Matrix points(4, 3);
    for (Index i = 0; i < points.rows(); ++i) {
      const double angle = 1.7 * static_cast<double>(i);
      points.row(i) =
          (wall.point + angle * (std::cos(angle) * along + std::sin(angle) * wall.normal.cross(along))).transpose();
    }
    const PotentialSamples found = potential_at(points, Side::exterior, position, sources, {}, instruments);
    if (kind == WallField::insulating) {
      BOOST_TEST((found.field * wall.normal).norm() < 1e-8 * found.field.norm());
    } else {
      const double mean = found.potential.mean();
      BOOST_TEST((found.potential.array() - mean).matrix().norm() < 1e-8 * found.field.norm());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
