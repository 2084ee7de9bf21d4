#include "bie/stepping/solve/tension_solve.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/tension.hpp"
#include "tests/stepping/stimson_jeffery.hpp"
#include "tests/support/several.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(tension_solve)

namespace {

constexpr PairSelection kStokesPairs{.stokes_single = true, .stokes_double = true};

/// Two spheres one above the other.
std::vector<Matrix> two_spheres(int order, double gap) {
  const Vector3 up(0.0, 0.0, 1.0 + gap / 2.0);
  return {translated(sphere(order), -up), translated(sphere(order), up)};
}

/// Spheres that forces ±1 pull along z.
Model pulled(double lower, double upper, double viscosity, double ratio) {
  Model model = with_vesicles(relaxation_model(0.1), 2);
  model.viscosity = viscosity;
  const double volume = 4.0 / 3.0 * std::numbers::pi;
  for (const std::size_t a : {0, 1}) {
    const GravityParameters weight{1.0, {0.0, 0.0, (a == 0 ? lower : upper) / volume}};
    model.vesicles[a].effects.push_back(std::make_shared<GravityEffect>(weight));
    model.vesicles[a].viscosity_ratio = ratio;
  }
  return model;
}

/// @param most  bound relative to the largest velocity
void keeps_every_area_element(const SolvedFields& found, double most) {
  for (std::size_t a = 0; a < found.vesicles.size(); ++a) {
    const Membrane& membrane = *found.vesicles[a].membrane;
    const SphereDerivatives u = membrane.fine.synthesize_gradient(found.fields.vesicles[a].velocity);
    const double speed = u.value.rowwise().norm().maxCoeff();
    BOOST_TEST(weighted_divergence(membrane, u).cwiseAbs().maxCoeff() < most * speed);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(drag_of_stimson_and_jeffery_is_the_tabulated_one) {
  struct Row {
    double gap, same, opposite;
  };
  for (const Row& row : {Row{4.0, 0.804721760670, 1.33015366395}, Row{2.0, 0.742258285069, 1.59668199950},
                         Row{0.5, 0.672915513765, 2.77241867956}}) {
    BOOST_TEST(std::abs(stimson_jeffery(row.gap).same - row.same) < 1e-11);
    BOOST_TEST(std::abs(stimson_jeffery(row.gap).opposite - row.opposite) < 1e-10);
  }
}

// Spheres are rigid, so the viscosity inside does not matter.
BOOST_AUTO_TEST_CASE(spheres_along_their_line_of_centres_move_as_stimson_and_jeffery_say) {
  struct Row {
    double gap;
    int order;
    double most;
  };
  for (const auto& [gap, order, most] :
       {Row{4.0, 16, 1e-8}, Row{2.0, 16, 1e-8}, Row{0.5, 16, 1e-8}, Row{0.1, 32, 1e-5}}) {
    const std::vector<Matrix> spheres = two_spheres(order, gap);
    const StimsonJeffery exact = stimson_jeffery(gap);
    for (const double viscosity_ratio : {1.0, 5.0}) {
      for (const double lower : {1.0, -1.0}) {
        const Model model = pulled(lower, 1.0, 2.5, viscosity_ratio);
        const State state = at_rest(spheres);
        const Discretisation discretisation = discretisation_of(spheres, {}, find_symmetry(model, state));
        const SolvedFields found = solved(model, discretisation, state);
        const double speed = 1.0 / (6.0 * std::numbers::pi * 2.5 * (lower > 0.0 ? exact.same : exact.opposite));
        const Vector3 below = translation(found.fields.vesicles[0].velocity);
        const Vector3 above = translation(found.fields.vesicles[1].velocity);
        BOOST_TEST(std::abs(above.z() - speed) < most * speed);
        BOOST_TEST((below - Vector3(0.0, 0.0, lower * speed)).norm() < most * speed);
        if (gap >= 0.5) BOOST_TEST(found.iterations_flow <= 10);
      }
    }
  }
}

// U/U₀ = 1 ± (3/2d − 1/d³) up to terms of fourth order in 1/d.
BOOST_AUTO_TEST_CASE(distant_spheres_move_as_far_limits_say) {
  constexpr double d = 60.0;
  const std::vector<Matrix> spheres = two_spheres(8, d - 2.0);
  for (const double lower : {1.0, -1.0}) {
    const Model model = pulled(lower, 1.0, 2.5, 1.0);
    const Discretisation discretisation = discretisation_of(spheres, {}, find_symmetry(model, at_rest(spheres)));
    const double alone = 1.0 / (6.0 * std::numbers::pi * 2.5);
    const double expected = 1.0 + lower * (1.5 / d - 1.0 / (d * d * d));
    const SolvedFields found = solved(model, discretisation, at_rest(spheres));
    BOOST_TEST(std::abs(translation(found.fields.vesicles[1].velocity).z() / alone - expected) < 10.0 / std::pow(d, 4));
  }
}

// v = E x satisfies the equations in all fluids if the membranes bear the jump of the viscous stress, 2(Λ − 1)μ E n.
BOOST_AUTO_TEST_CASE(a_flow_common_to_all_fluids_is_found_between_membranes_of_any_viscosity) {
  const int order = 14;
  const Matrix one = asymmetric_shape(order), two = translated(ellipsoid(order, {0.7, 0.8, 0.9}), {2.3, -0.2, 0.4});
  const SeveralMembranes pair(order, {one, two}, kStokesLayers, kStokesPairs);
  const double viscosity = 1.7;
  Matrix3 strain;
  strain << 0.3, 0.5, -0.2, 0.5, 0.4, 0.1, -0.2, 0.1, -0.7;
  const double ratios[] = {4.0, 0.2};
  std::vector<Membrane> membranes;
  for (const std::size_t a : {0, 1}) {
    membranes.push_back(make_membrane(pair.space, pair.positions[a], kStokesLayers, ratios[a]));
  }
  std::vector<FlowMembrane> members;
  std::vector<Matrix> weighted, exact;
  for (const std::size_t a : {0, 1}) {
    members.push_back({{viscosity, ratios[a], false, {}}, membranes[a]});
    const Matrix force = 2.0 * viscosity * (ratios[a] - 1.0) * membranes[a].surface.normal * strain;
    weighted.push_back(membranes[a].weighted(force));
    exact.emplace_back(pair.positions[a] * strain);
  }
  MembraneFlow flow(members, pair.interaction);
  const std::vector<Matrix> found = flow.velocities(weighted, exact);
  for (const std::size_t a : {0, 1}) {
    BOOST_TEST(relative_difference(found[a], exact[a]) < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(tensions_of_two_shapes_keep_every_area_element_of_both) {
  const std::vector<Matrix> shapes{asymmetric_shape(12), translated(ellipsoid(12, {0.7, 0.5, 0.9}), {2.4, 0.1, 0.7})};
  Model model = with_vesicles(shear_model(), 2);
  model.vesicles[1].viscosity_ratio = 3.0;
  const Discretisation discretisation = discretisation_of(shapes);
  const SolvedFields found = solved(model, discretisation, at_rest(shapes));
  keeps_every_area_element(found, 1e-7);
  for (const std::size_t a : {0, 1}) {
    const Membrane& membrane = *found.vesicles[a].membrane;
    const Matrix u = membrane.fine.synthesize(found.fields.vesicles[a].velocity);
    const Vector through = row_dot(u, membrane.surface.normal);
    BOOST_TEST(std::abs(through.dot(membrane.surface.quadrature)) < 1e-5 * u.rowwise().norm().maxCoeff());
  }
}

// Many vesicles use other preconditioners; a sphere among them has none of its own.
BOOST_AUTO_TEST_CASE(tensions_of_many_keep_every_area_element_of_all) {
  std::vector<Matrix> shapes;
  for (int i = 0; i < 10; ++i) {
    const Matrix shape = i == 4 ? sphere(8) : Matrix((0.8 + 0.02 * i) * asymmetric_shape(8));
    shapes.push_back(translated(shape, {2.9 * (i % 3), 2.8 * (i / 3), 0.1 * i}));
  }
  Model model = with_vesicles(shear_model(), shapes.size());
  model.vesicles[1].viscosity_ratio = 3.0;
  const SolvedFields found = solved(model, discretisation_of(shapes), at_rest(shapes));
  keeps_every_area_element(found, 1e-6);
  BOOST_TEST(found.vesicles[4].is_sphere);
  BOOST_TEST(found.iterations_flow <= 25);
}

BOOST_AUTO_TEST_CASE(directions_of_a_solve_serve_the_next) {
  const std::vector<Matrix> shapes{asymmetric_shape(8), translated(ellipsoid(8, {0.7, 0.5, 0.9}), {2.4, 0.1, 0.7})};
  const Model model = with_vesicles(shear_model(), 2);
  const Discretisation discretisation = discretisation_of(shapes);
  State state = at_rest(shapes);
  const SolvedFields first = solved(model, discretisation, state);
  for (const std::size_t a : {0, 1}) state.vesicles[a].recycled = first.vesicles[a].recycled;
  const SolvedFields second = solved(model, discretisation, state);
  BOOST_TEST(2 * second.iterations_flow < first.iterations_flow);
  for (const std::size_t a : {0, 1}) {
    BOOST_TEST(relative_difference(second.fields.vesicles[a].velocity, first.fields.vesicles[a].velocity) < 1e-7);
  }
}

BOOST_AUTO_TEST_SUITE_END()
