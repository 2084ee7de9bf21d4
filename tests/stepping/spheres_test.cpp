#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/poiseuille_flow.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "tests/stepping/stimson_jeffery.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

// Inextensible spheres, alone and among others, against exact solutions at every accepted step, in steps of a fixed
// size and in the long ones that a tolerance allows: a rigid motion contributes no error.
BOOST_AUTO_TEST_SUITE(spheres)

namespace {

constexpr int kDegree = 8;
constexpr double kRadius = 1.3;
const Vector3 kCentre(0.3, -0.2, 0.5);

/// Time stepping of a run: in steps of dt, or with a tolerance.
struct Steps {
  int time_order;
  double tolerance = 0.0, dt = 0.25;

  friend std::ostream& operator<<(std::ostream& out, const Steps& steps) {
    return out << "order " << steps.time_order << ", tolerance " << steps.tolerance;
  }
};

std::vector<Steps> all_steps() {
  std::vector<Steps> result;
  for (int order = 1; order <= highest_time_order; ++order) result.push_back({order});
  for (int order = 2; order <= highest_time_order; ++order) result.push_back({order, 1e-3});
  for (const double tolerance : {1e-1, 1e-2, 1e-6}) result.push_back({4, tolerance});
  return result;
}

using Look = std::function<void(const State&, const Evaluation&)>;

/// @param look  called at the start and after every accepted step
/// @returns number of steps
int run(const Model& model, const std::vector<StartMembrane>& start, const Steps& steps, double end_time,
        const Look& look) {
  EvolutionSetup setup{model, {}, {}, fixed_steps(steps.dt)};
  setup.settings.order = steps.tolerance > 0.0 ? 16 : kDegree;
  setup.settings.time_order = steps.time_order;
  if (steps.tolerance > 0.0) setup.control = {end_time, 1e-9 * end_time, steps.tolerance};
  Instruments instruments;
  Evolution evolution(setup, start, instruments);
  evolution.evaluate_start();
  look(evolution.state(), evolution.evaluation());
  int n_steps = 0;
  for (; evolution.state().time < end_time; ++n_steps) {
    evolution.step({{}, end_time});
    look(evolution.state(), evolution.evaluation());
  }
  return n_steps;
}

Vector3 centroid_velocity(const VesicleDiagnostics& d) {
  return {d.centroid_velocity_x, d.centroid_velocity_y, d.centroid_velocity_z};
}

Vector3 place(const VesicleDiagnostics& d) { return {d.centroid_x, d.centroid_y, d.centroid_z}; }

/// Largest difference of an extent from the diameter of a sphere, over the radius.
double deformation(const VesicleDiagnostics& d, double radius) {
  return std::max({std::abs(d.extent_x - 2.0 * radius), std::abs(d.extent_y - 2.0 * radius),
                   std::abs(d.extent_z - 2.0 * radius)}) /
         radius;
}

/// Ω from ∫ r × v dA = (2/3) A R² Ω.
Vector3 rotation_rate(const VesicleSolution& solution, const VesicleFields& fields) {
  const Surface& s = solution.membrane->surface;
  const Matrix velocity = solution.membrane->fine.synthesize(fields.velocity);
  const Vector3 centre = centroid(s);
  Vector3 moment = Vector3::Zero();
  for (Index i = 0; i < velocity.rows(); ++i) {
    const Vector3 r = Vector3(s.position.row(i)) - centre;
    moment += s.quadrature[i] * r.cross(Vector3(velocity.row(i)));
  }
  return 1.5 / (s.quadrature.sum() * std::pow(solution.membrane->radius, 2)) * moment;
}

Vector3 vorticity(const Matrix3& gradient) {
  return {gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0), gradient(1, 0) - gradient(0, 1)};
}

std::vector<BackgroundFlow> linear_flows() {
  BackgroundFlow mixed;
  mixed.gradient << 0.2, 0.1, 0.7, -0.2, -0.3, 0.1, 0.3, 0.2, 0.1;
  return {shear_flow(1.0), planar_extension(-0.8), axisymmetric_extension(0.7), mixed};
}

StartMembrane off_centre_sphere() { return {translated(sphere(kDegree, kRadius), kCentre)}; }

}  // namespace

// Einstein's viscosity, and a centre that follows the fluid: x(t) = exp(∇v t) x(0).
BOOST_AUTO_TEST_CASE(every_linear_flow_turns_a_sphere_and_is_as_viscous_as_einstein_says) {
  for (const BackgroundFlow& flow : linear_flows()) {
    for (const Steps& steps : all_steps()) {
      BOOST_TEST_CONTEXT(steps << ", gradient " << flow.gradient.reshaped().transpose()) {
        Model model = relaxation_model(0.1);
        model.flow = flow;
        const Vector3 exact = 0.5 * vorticity(flow.gradient);
        double wrong = 0.0, viscosity = 0.0;
        run(model, {off_centre_sphere()}, steps, 3.0, [&](const State&, const Evaluation& e) {
          const VesicleDiagnostics& d = e.diagnostics.vesicles[0];
          wrong = std::max({wrong, deformation(d, kRadius), (centroid_velocity(d) - flow.gradient * place(d)).norm(),
                            (rotation_rate(e.vesicles[0], e.fields.vesicles[0]) - exact).norm(), std::abs(d.area_drift),
                            d.strain_max});
          viscosity = std::max(viscosity, std::abs(d.rheology.intrinsic_viscosity() - 2.5));
        });
        BOOST_TEST(wrong < 1e-9);
        BOOST_TEST(viscosity < 1e-9);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(spheres_in_tubes_and_under_gravity_move_as_faxen_and_stokes_say) {
  const double centre_velocity = 0.8, tube = 5.0;
  const Vector3 g(0.3, -0.4, -1.2);
  Model model = relaxation_model(0.1);
  model.effects.push_back(
      std::make_shared<PoiseuilleFlowEffect>(PoiseuilleParameters{centre_velocity, tube, Waveform{}}));
  model.effects.push_back(std::make_shared<GravityEffect>(GravityParameters{0.7, g}));
  for (const Steps& steps : all_steps()) {
    BOOST_TEST_CONTEXT(steps) {
      double wrong = 0.0;
      run(model, {off_centre_sphere()}, steps, 3.0, [&](const State&, const Evaluation& e) {
        const VesicleDiagnostics& d = e.diagnostics.vesicles[0];
        const double off_axis2 = place(d).tail<2>().squaredNorm();
        Vector3 exact = 2.0 / 9.0 * 0.7 * kRadius * kRadius * g;
        exact.x() += centre_velocity * (1.0 - (off_axis2 + 2.0 / 3.0 * kRadius * kRadius) / (tube * tube));
        wrong = std::max({wrong, deformation(d, kRadius), (centroid_velocity(d) - exact).norm()});
      });
      BOOST_TEST(wrong < 1e-9);
    }
  }
}

// Of two pairs far from each other, driven together, the small one has the smaller gap and needs the lower degree.
BOOST_AUTO_TEST_CASE(pairs_in_narrow_gaps_approach_as_exactly_as_the_tolerance) {
  struct Pair {
    double radius, gap;  // gap over the radius
  };
  const std::vector<Pair> pairs{{1.0, 0.1}, {0.1, 0.5}};
  Model model = with_vesicles(relaxation_model(0.1), 4);
  std::vector<StartMembrane> start;
  for (std::size_t a = 0; a < 4; ++a) {
    const auto& [radius, gap] = pairs[a / 2];
    const double side = a % 2 == 0 ? -1.0 : 1.0;
    const Vector3 centre(a < 2 ? 0.0 : 100.0, 0.0, side * radius * (1.0 + 0.5 * gap));
    start.push_back({translated(sphere(kDegree, radius), centre)});
    model.vesicles[a].effects.push_back(std::make_shared<GravityEffect>(GravityParameters{1.0, {0.0, 0.0, -side}}));
  }
  for (const double tolerance : {1e-2, 1e-3}) {
    EvolutionSetup setup{model, {}, {}, {1.0, 1e-9, tolerance}};
    setup.settings.order = 32;
    Instruments instruments;
    Evolution evolution(setup, start, instruments);
    evolution.evaluate_start();
    for (std::size_t a = 0; a < 4; ++a) {
      const auto& [radius, gap] = pairs[a / 2];
      const double exact = 2.0 / 9.0 * radius * radius / (model.viscosity * stimson_jeffery(gap).opposite);
      const double found = std::abs(evolution.evaluation().diagnostics.vesicles[a].centroid_velocity_z);
      BOOST_TEST(std::abs(found / exact - 1.0) < tolerance, "sphere " << a << ": " << found / exact - 1.0);
    }
    BOOST_TEST(order_of(evolution.state().vesicles[0].position.rows()) >
               order_of(evolution.state().vesicles[2].position.rows()));
  }
}

// A sphere read from a file, converted to other units or left by an earlier run is a sphere up to rounding.
BOOST_AUTO_TEST_CASE(a_sphere_up_to_rounding_is_a_sphere) {
  Model model = shear_model();
  for (const double excess : {1e-15, 1e-12, 1e-9, 1e-7}) {
    for (const Steps& steps : {Steps{1}, Steps{4}, Steps{4, 1e-3}}) {
      BOOST_TEST_CONTEXT(steps << ", excess " << excess) {
        double viscosity = 0.0, deformed = 0.0;
        run(model, {StartMembrane{ellipsoid(kDegree, {1.0, 1.0 - excess, 1.0 + excess})}}, steps, 3.0,
            [&](const State&, const Evaluation& e) {
              const VesicleDiagnostics& d = e.diagnostics.vesicles[0];
              viscosity = std::max(viscosity, std::abs(d.rheology.intrinsic_viscosity() - 2.5));
              deformed = std::max(deformed, deformation(d, 1.0));
            });
        BOOST_TEST(viscosity < 1e-9 + 10.0 * excess);
        BOOST_TEST(deformed < 1e-9 + 10.0 * excess);
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
