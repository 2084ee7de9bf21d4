#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>

#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/spontaneous_curvature.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(exchange)

namespace {

constexpr int kOrder = 6;
const Isometry kInversion{{-1, -1, -1}};

/// Small enough to fit beside its images, without any symmetry of its own.
Matrix small_shape(const Vector3& place) { return translated(0.7 * asymmetric_shape(kOrder), place); }

std::vector<Matrix> images_of(const Matrix& shape, const std::vector<Isometry>& maps) {
  std::vector<Matrix> shapes{shape};
  for (const Isometry& map : maps) shapes.push_back(ImageOfFields{map}.vector(shape));
  return shapes;
}

std::vector<Matrix> ring_of_three() { return images_of(small_shape({1.6, 0.0, 0.2}), {{{}, 1, 3}, {{}, 2, 3}}); }

std::vector<Matrix> inverted_pair() { return images_of(small_shape({1.1, 0.3, 0.8}), {kInversion}); }

State start_of(const Model& model, const std::vector<Matrix>& shapes) {
  State state = at_rest(shapes);
  for (VesicleState& vesicle : state.vesicles) {
    if (model.electric) vesicle.transmembrane_potential = Vector::Zero(vesicle.position.rows());
  }
  return state;
}

/// Vesicles with fluids of their own in a field; the caller sets charging and bending.
Model viscous_model(std::size_t n) {
  Model model = field_model();
  model.vesicles[0].viscosity_ratio = 3.0;
  return with_vesicles(model, n);
}

/// End of a run with or without use of the symmetry, and the work of the run.
struct End {
  State state;
  Evaluation evaluation;
  std::map<std::string, std::uint64_t> kernels, pairs;
};

struct Way {
  double dt = 0.01, tolerance = 0.0;
  int time_order = 2, n_steps = 2;
  bool steady = false;
};

End end_of(const Model& model, const std::vector<Matrix>& shapes, Symmetry symmetry, bool uses_exchange,
           const Way& way) {
  Instruments instruments;
  EvolutionSetup setup{model, solved_to_rounding(kOrder), std::move(symmetry), fixed_steps(way.dt)};
  setup.settings.time_order = way.time_order;
  setup.settings.curvature_tolerance = 1e-7;
  setup.settings.longitude_fold = setup.symmetry.exchange.fold();
  if (way.tolerance > 0.0) {
    setup.settings.order = 12;
    setup.control = {1.0, 1e-9, way.tolerance};
  }
  if (!uses_exchange) setup.symmetry.exchange = {};
  std::vector<StartMembrane> start;
  for (const Matrix& shape : shapes) start.push_back({shape, {.steady = way.steady}});
  Evolution evolution(setup, start, instruments);
  evolution.evaluate_start();
  const double end = way.n_steps * way.dt;
  while (evolution.state().time < end) evolution.step({{}, end});
  return {evolution.state(), evolution.evaluation(), instruments.kernel_evaluations(), instruments.pair_targets()};
}

double largest_difference_of(const std::vector<VesicleDiagnostics>& a, const std::vector<VesicleDiagnostics>& b) {
  double largest = 0.0;
  for (const auto column :
       {&VesicleDiagnostics::area, &VesicleDiagnostics::centroid_x, &VesicleDiagnostics::centroid_y,
        &VesicleDiagnostics::centroid_z, &VesicleDiagnostics::centroid_velocity_x, &VesicleDiagnostics::extent_x,
        &VesicleDiagnostics::extent_y, &VesicleDiagnostics::Vm_max, &VesicleDiagnostics::Vm_pole_plus,
        &VesicleDiagnostics::Vm_north, &VesicleDiagnostics::q_north, &VesicleDiagnostics::tension_max,
        &VesicleDiagnostics::bending_energy_scaled}) {
    for (std::size_t v = 0; v < a.size(); ++v) {
      // An axis that misses the membrane has no pole.
      const double one = a[v].*column, other = b[v].*column;
      if (std::isfinite(one) || std::isfinite(other)) largest = std::max(largest, std::abs(one - other));
    }
  }
  for (std::size_t v = 0; v < a.size(); ++v) {
    const Rheology &one = a[v].rheology, &other = b[v].rheology;
    for (const auto share : {&Rheology::bending, &Rheology::tension, &Rheology::electric, &Rheology::others}) {
      largest = std::max(largest, (one.*share - other.*share).cwiseAbs().maxCoeff());
    }
    largest = std::max(largest, (one.dipole - other.dipole).cwiseAbs().maxCoeff());
    largest = std::max(largest, (one.other_force - other.other_force).cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Remaining shares of the work of operators and of pairs.
struct Work {
  double kernels, pairs;
};

/// Checks that exchange changes no number of a run and leaves this share of the work of operators and of pairs.
void check_same_run(const Model& model, const std::vector<Matrix>& shapes, const std::string& text, const Work& share,
                    const Way& way = {}, double most = 1e-9) {
  const Symmetry symmetry = find_symmetry(model, start_of(model, shapes));
  BOOST_TEST(symmetry_text(symmetry) == text);
  const End with = end_of(model, shapes, symmetry, true, way), without = end_of(model, shapes, symmetry, false, way);
  double difference = 0.0;
  for (std::size_t a = 0; a < shapes.size(); ++a) {
    const VesicleState &one = with.state.vesicles[a], &other = without.state.vesicles[a];
    BOOST_TEST_REQUIRE(one.position.rows() == other.position.rows());
    difference = std::max(difference, max_difference(one.position, other.position));
    if (one.transmembrane_potential.size() > 0) {
      difference = std::max(difference, max_difference(one.transmembrane_potential, other.transmembrane_potential));
    }
    const VesicleFields &fields = with.evaluation.fields.vesicles[a], &others = without.evaluation.fields.vesicles[a];
    difference = std::max(difference, max_difference(fields.velocity, others.velocity));
    if (fields.charge.size() > 0) difference = std::max(difference, max_difference(fields.charge, others.charge));
  }
  BOOST_TEST(difference < most);
  BOOST_TEST(largest_difference_of(with.evaluation.diagnostics.vesicles, without.evaluation.diagnostics.vesicles) <
             100.0 * most);
  const auto sum = [](const std::map<std::string, std::uint64_t>& counts) {
    double all = 0.0;
    for (const auto& [name, count] : counts) all += static_cast<double>(count);
    return all;
  };
  BOOST_TEST(sum(with.kernels) == share.kernels * sum(without.kernels), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(sum(with.pairs) == share.pairs * sum(without.pairs), boost::test_tools::tolerance(1e-12));
}

}  // namespace

BOOST_AUTO_TEST_CASE(two_that_an_inversion_exchanges) {
  Model model = viscous_model(2);
  model.electric->field = {0.2, -0.3, 0.9};
  model.flow = shear_flow(1.0);
  model.contact = ContactParameters{0.1, 0.5};
  for (VesicleModel& vesicle : model.vesicles) {
    vesicle.effects.push_back(std::make_shared<SpontaneousCurvatureEffect>(SpontaneousCurvatureParameters{0.1, -0.4}));
  }
  check_same_run(model, inverted_pair(), "vesicles exchanged by inversion", {0.5, 0.5}, {.steady = true});
}

BOOST_AUTO_TEST_CASE(a_ring_that_turns_exchange) {
  Model model = viscous_model(3);
  model.flow = axisymmetric_extension(0.4);
  for (VesicleModel& vesicle : model.vesicles) {
    vesicle.effects.push_back(std::make_shared<GravityEffect>(GravityParameters{0.8, {0.0, 0.0, -1.0}}));
  }
  check_same_run(model, ring_of_three(), "vesicles exchanged by 3-fold turns about z", {1.0 / 3.0, 1.0 / 3.0});
}

BOOST_AUTO_TEST_CASE(four_that_two_mirrors_exchange) {
  const std::vector<Matrix> shapes =
      images_of(small_shape({0.9, 1.4, 0.3}), {{{-1, 1, 1}}, {{1, -1, 1}}, {{-1, -1, 1}}});
  check_same_run(with_vesicles(field_model(), 4), shapes,
                 "vesicles exchanged by mirror x and mirror y and half turn about z", {0.25, 0.25}, {.time_order = 1});
}

// The middle vesicle is its own image.
BOOST_AUTO_TEST_CASE(two_on_both_sides_of_a_third) {
  std::vector<Matrix> shapes = images_of(small_shape({1.9, 0.3, 1.2}), {kInversion});
  shapes.push_back(ellipsoid(kOrder, {0.8, 0.6, 0.7}));
  Model model = with_vesicles(shear_model(), 3);
  model.vesicles[2].bending->modulus = 0.3;
  const Symmetry symmetry = find_symmetry(model, start_of(model, shapes));
  BOOST_TEST(symmetry_text(symmetry) == "vesicles exchanged by inversion");
  BOOST_TEST((symmetry.exchange.originals() == std::vector<std::size_t>{0, 0, 2}));
  // Of the six blocks between two vesicles, those from 0 to 1 and 2 and from 2 to 0 remain.
  check_same_run(model, shapes, "vesicles exchanged by inversion", {2.0 / 3.0, 0.5});
}

BOOST_AUTO_TEST_CASE(two_on_an_axis_that_a_mirror_exchanges) {
  const Matrix shape = ellipsoid(kOrder, {1.0, 1.0, 1.3});
  const std::vector<Matrix> shapes{translated(shape, {0.0, 0.0, 1.8}), translated(shape, {0.0, 0.0, -1.8})};
  check_same_run(with_vesicles(field_model(), 2), shapes, "axisymmetric about z, vesicles exchanged by mirror z",
                 {0.5, 0.5});
}

BOOST_AUTO_TEST_CASE(displacement_currents_of_two) {
  Model model = viscous_model(2);
  model.electric->displacement_current = true;
  check_same_run(model, inverted_pair(), "vesicles exchanged by inversion", {0.5, 0.5});
}

BOOST_AUTO_TEST_CASE(the_averaged_field_of_two) {
  Model model = viscous_model(2);
  model.electric->averaged_frequency = 0.3;
  check_same_run(model, inverted_pair(), "vesicles exchanged by inversion", {0.5, 0.5}, {.time_order = 1});
}

BOOST_AUTO_TEST_CASE(a_tolerance_gives_images_the_degree_of_their_originals) {
  Model model = viscous_model(2);
  const std::vector<Matrix> shapes = inverted_pair();
  const Symmetry symmetry = find_symmetry(model, start_of(model, shapes));
  const End end = end_of(model, shapes, symmetry, true, {.dt = 0.05, .tolerance = 1e-2, .time_order = 3, .n_steps = 4});
  const auto order = [&](std::size_t a) { return order_of(end.state.vesicles[a].position.rows()); };
  BOOST_TEST(order(0) > kOrder);
  BOOST_TEST(order(1) == order(0));
  BOOST_TEST(max_difference(end.state.vesicles[1].position,
                            ImageOfFields{kInversion}.vector(end.state.vesicles[0].position)) == 0.0);
}

BOOST_AUTO_TEST_CASE(only_equal_vesicles_are_exchanged) {
  const std::vector<Matrix> shapes = inverted_pair();
  const auto exchanged = [&](const Model& model, const std::vector<Matrix>& positions) {
    return find_symmetry(model, start_of(model, positions)).exchange.any();
  };
  const Model model = viscous_model(2);
  BOOST_TEST(exchanged(model, shapes));
  BOOST_TEST(!exchanged(model, {shapes[0], 1.001 * shapes[1]}));
  BOOST_TEST(!exchanged(model, {shapes[0], translated(shapes[1], {0.01, 0.0, 0.0})}));
  Model unlike = model;
  unlike.vesicles[1].bending->modulus = 0.2;
  BOOST_TEST(!exchanged(unlike, shapes));
  unlike = model;
  unlike.vesicles[1].inside.conductivity = 3.0;
  BOOST_TEST(!exchanged(unlike, shapes));
  unlike = model;
  unlike.vesicles[0].effects.push_back(
      std::make_shared<SpontaneousCurvatureEffect>(SpontaneousCurvatureParameters{0.1, -0.4}));
  BOOST_TEST(!exchanged(unlike, shapes));
  // An inversion reverses gravity.
  Model heavy = model;
  for (VesicleModel& vesicle : heavy.vesicles) {
    vesicle.effects.push_back(std::make_shared<GravityEffect>(GravityParameters{0.8, {0.0, 0.0, -1.0}}));
  }
  BOOST_TEST(!exchanged(heavy, shapes));
  State charged = start_of(model, shapes);
  charged.vesicles[0].transmembrane_potential[2] = charged.vesicles[1].transmembrane_potential[2] = 0.1;
  BOOST_TEST(find_symmetry(model, charged).exchange.any());
  charged.vesicles[1].transmembrane_potential[2] = -0.1;
  BOOST_TEST(!find_symmetry(model, charged).exchange.any());
}

BOOST_AUTO_TEST_SUITE_END()
