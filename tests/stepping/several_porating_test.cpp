#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/physics/effects/poration.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "tests/stepping/varying_membrane.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(several_porating)

using namespace vehd;
using namespace vehd::testing;

namespace {

Model porating_model(bool relaxes) {
  Model model = relaxation_model(0.05);
  set_electric(model, {{0.3, 0.0, 1.0}, 0.5, 1.0, 0.3, 0.6}, {0.5, 0.2});
  model.electric->displacement_current = relaxes;
  model.vesicles[0].reaction = std::make_shared<PoreDensity>(PoreParameters{2.0, 0.4, 1.0, 2.46, 0.3});
  return model;
}

/// Two vesicles near each other, with different fluids and membranes.
struct TwoVesicles {
  Model model;
  std::vector<Matrix> shapes;

  explicit TwoVesicles(bool relaxes) : model(with_vesicles(porating_model(relaxes), 2)) {
    VesicleModel& other = model.vesicles[1];
    other.inside = {2.0, 1.5};
    other.charging = {0.4, 0.1};
    other.reaction = std::make_shared<MembranePorosity>(PorosityParameters{3.0, 0.6, 3.0, 0.2, 50.0});
    const Matrix shape = ellipsoid(8, {1.0, 0.9, 1.2});
    shapes = {translated(shape, {0.0, 0.0, -1.5}), translated(0.9 * shape, {0.2, 0.0, 1.5})};
  }

  [[nodiscard]] Discretisation spaces(int time_order) const {
    return testing::discretisation_of(shapes, tight_settings(time_order));
  }
  [[nodiscard]] State end_of(int time_order, double end, int n_steps) const {
    const Discretisation discretisation = spaces(time_order);
    const double dt = end / n_steps;
    return run(model, discretisation, start(model, discretisation, shapes, dt), dt, n_steps);
  }
};

double largest_difference_of_all(const State& one, const State& other) {
  double result = 0.0;
  for (std::size_t a = 0; a < one.vesicles.size(); ++a) {
    const VesicleState &x = one.vesicles[a], &y = other.vesicles[a];
    result = std::max({result, max_difference(x.transmembrane_potential, y.transmembrane_potential),
                       max_difference(x.poration, y.poration)});
    if (x.free_charge.size() > 0) result = std::max(result, max_difference(x.free_charge, y.free_charge));
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_step_is_backward_euler) {
  for (const bool relaxes : {false, true}) {
    TwoVesicles two(relaxes);
    two.model.mobile = false;
    const double dt = 0.3;
    const Discretisation discretisation = two.spaces(1);
    State state = start(two.model, discretisation, two.shapes, dt);
    for (int step = 0; step < 2; ++step) {
      const State before = state;
      state = run(two.model, discretisation, before, dt, 1);
      // The rates at its end, from the equation for q, up to the truncation of products with G_m(x).
      const SolvedFields end = solved(two.model, discretisation, state);
      for (std::size_t a = 0; a < 2; ++a) {
        const VesicleState &now = state.vesicles[a], &was = before.vesicles[a];
        const Vector charged = now.transmembrane_potential - was.transmembrane_potential;
        const double of_charge =
            max_difference(dt * end.vesicles[a].rate.transmembrane_potential, charged) / charged.norm();
        BOOST_TEST(of_charge < 3e-3, relaxes << ": " << of_charge);
        const Vector opened = now.poration - was.poration;
        const double of_pores = max_difference(dt * end.vesicles[a].rate.poration, opened) / opened.norm();
        BOOST_TEST(of_pores < 1e-2, relaxes << ": " << of_pores);
        BOOST_TEST(opened.norm() > 0.01);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(two_frozen_vesicles_keep_every_order_in_time) {
  for (const bool relaxes : {false, true}) {
    TwoVesicles two(relaxes);
    two.model.mobile = false;
    const State exact = two.end_of(highest_time_order, 0.15, 16);
    for (int order = 1; order <= highest_time_order; ++order) {
      const double coarse = largest_difference_of_all(two.end_of(order, 0.15, 4), exact);
      const double fine = largest_difference_of_all(two.end_of(order, 0.15, 8), exact);
      BOOST_TEST_MESSAGE(relaxes << " " << order << ": " << coarse << " " << fine);
      BOOST_TEST(std::log2(coarse / fine) > order - 0.6, order << ": " << coarse << " " << fine);
    }
  }
}

BOOST_AUTO_TEST_CASE(copies_far_apart_porate_and_move_as_one_vesicle) {
  for (const bool relaxes : {false, true}) {
    const Model model = porating_model(relaxes);
    const Matrix shape = asymmetric_shape(8);
    const std::vector<Matrix> shapes{shape, translated(shape, {0.0, 2e4, 1e4}), translated(shape, {3e4, 0.0, 0.0})};
    const Model of_all = with_vesicles(model, 3);
    const double dt = 0.05;
    const Discretisation together = testing::discretisation_of(shapes, tight_settings(2)),
                         alone = testing::discretisation_of({shape}, tight_settings(2));
    const State all = run(of_all, together, start(of_all, together, shapes, dt), dt, 2);
    const State one = run(model, alone, start(model, alone, shape, dt), dt, 2);
    for (std::size_t a = 0; a < 3; ++a) {
      State copy = one;
      copy.vesicles[0] = all.vesicles[a];
      // With coordinates of 1e4 rounding leaves 1e-12.
      BOOST_TEST(max_difference(all.vesicles[a].position - (shapes[a] - shape), one.vesicles[0].position) < 1e-8);
      BOOST_TEST(largest_difference_of_all(copy, one) < 1e-8);
    }
    BOOST_TEST(one.vesicles[0].poration.norm() > 0.01);
  }
}

BOOST_AUTO_TEST_CASE(a_porosity_that_does_not_change_is_a_conductance) {
  // X is 0.4 everywhere and constant, G_1 = 3: G_m is larger by 1.2.
  for (const bool relaxes : {false, true}) {
    TwoVesicles two(relaxes);
    Model plain = two.model;
    for (std::size_t a = 0; a < 2; ++a) {
      two.model.vesicles[a].reaction =
          std::make_shared<MembranePorosity>(PorosityParameters{3.0, 0.6, 3.0, 1e12, 1e13});
      plain.vesicles[a].reaction.reset();
      plain.vesicles[a].charging.conductance += 1.2;
    }
    const double dt = 0.1;
    const Discretisation discretisation = two.spaces(2);
    State porous = start(two.model, discretisation, two.shapes, dt);
    for (VesicleState& vesicle : porous.vesicles) vesicle.poration[0] = 0.4 * kEverywhere;
    porous = run(two.model, discretisation, porous, dt, 2);
    const State conducting = run(plain, discretisation, start(plain, discretisation, two.shapes, dt), dt, 2);
    for (std::size_t a = 0; a < 2; ++a) {
      const VesicleState &x = porous.vesicles[a], &y = conducting.vesicles[a];
      BOOST_TEST(max_difference(x.transmembrane_potential, y.transmembrane_potential) < 1e-9, relaxes);
      BOOST_TEST(max_difference(x.position, y.position) < 1e-9, relaxes);
    }
  }
}

BOOST_AUTO_TEST_CASE(places_of_each_go_with_pores_and_displacement_currents) {
  Model model = with_vesicles(porating_model(true), 2);
  model.mobile = false;
  for (VesicleModel& vesicle : model.vesicles) {
    vesicle.has_varying_properties = true;
    vesicle.pump.emplace();
  }
  const std::vector<Matrix> shapes{sphere(6), translated(sphere(6), {0.0, 2e4, 0.0})};
  const NumericalSettings settings = solved_to_rounding(6);
  const double dt = 0.1;
  const MembraneMaterial material = electric_material(6);
  const Discretisation together = testing::discretisation_of(shapes, settings), alone(settings, {});
  const State both = run(model, together, varying_start(model, together, shapes, dt, {material, material}), dt, 2);
  Model of_one = model;
  of_one.vesicles.resize(1);
  const State one = run(of_one, alone, varying_start(of_one, alone, sphere(6), dt, material), dt, 2);
  for (const VesicleState& vesicle : both.vesicles) {
    State copy = one;
    copy.vesicles[0] = vesicle;
    BOOST_TEST(largest_difference_of_all(copy, one) < 1e-8);
  }
  BOOST_TEST(one.vesicles[0].transmembrane_potential.norm() > 0.1);
}

BOOST_AUTO_TEST_SUITE_END()
