#include "bie/stepping/solve/flow_system.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/stepping/solve/sphere_spectrum.hpp"
#include "bie/stepping/solve/tension_solve.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(flow_system)

namespace {

FlowParameters parameters_of(const Model& model) { return flow_parameters(model, model.vesicles[0]); }

constexpr int kOrder = 12;
constexpr double kDt = 0.3;

Model stiff_model() {
  Model model = relaxation_model(0.7);
  model.viscosity = 1.9;
  return model;
}

/// System of a step of one membrane.
class StepSystem {
 public:
  StepSystem(const Model& model, const Membrane& membrane, double dt = kDt, RecycledSubspace recycled = {})
      : alone_{{parameters_of(model), membrane}},
        flow_(alone_, none_),
        system_(equations(dt), flow_, {std::move(recycled)}) {}

  FlowSystem::Solution solve(const FlowScalars& right_side, double tolerance) {
    return system_.solve({system_.equations().front().rows(right_side)}, tolerance);
  }
  /// Velocity for the given unknowns.
  Matrix velocity(const FlowScalars& unknowns) {
    const FlowEquations& one = system_.equations().front();
    return flow_.velocities({one.membrane().weighted(one.force(unknowns))}).front();
  }
  /// Left side of the coupled system, computed from its parts.
  FlowScalars left_side(const FlowScalars& unknowns, double dt = kDt) {
    const Membrane& membrane = alone_.front().membrane;
    const SphereDerivatives u = membrane.fine.synthesize_derivatives(velocity(unknowns));
    Vector curvature = -dt * curvature_increment(membrane, membrane.fine, u);
    if (unknowns.shape.size() > 0) curvature += unknowns.shape;
    return {curvature, weighted_divergence(membrane, u)};
  }
  [[nodiscard]] RecycledSubspace found() const { return system_.found().front(); }
  [[nodiscard]] RecycledSubspace kept() const { return system_.kept().front(); }

 private:
  [[nodiscard]] std::vector<FlowEquations> equations(double dt) const {
    FlowOptions options;
    options.dt = dt;
    std::vector<FlowEquations> result;
    result.emplace_back(alone_.front(), options);
    return result;
  }

  std::vector<FlowMembrane> alone_;
  Interaction none_;
  MembraneFlow flow_;
  FlowSystem system_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(sphere_flow_block_is_the_assembled_operator_on_a_sphere) {
  const double radius = 1.6;
  Model model = stiff_model();
  const Space space(kOrder);
  for (const double ratio : {1.0, 0.0, 0.2, 30.0}) {
    model.vesicles[0].viscosity_ratio = ratio;
    const Membrane membrane = make_membrane(space, sphere(kOrder, radius), kStokesLayers, ratio);
    const SphereFlow parameters{radius, model.viscosity, model.vesicles[0].bending->modulus, kDt, ratio};
    StepSystem system(model, membrane);
    for (int n = 0; n <= kOrder / 2; ++n) {
      const Eigen::Matrix2d block = sphere_flow_block(parameters, n);
      for (const int m : {-n, 0, n}) {
        const Vector y = harmonic(kOrder, n, m);
        const FlowScalars of_curvature = system.left_side({y, {}});
        const FlowScalars of_tension = system.left_side({{}, y});
        const double scale = block.cwiseAbs().maxCoeff();
        BOOST_TEST_CONTEXT("viscosity ratio " << ratio << ", degree " << n << ", order " << m) {
          BOOST_TEST(max_difference(of_curvature.shape, block(0, 0) * y) < 1e-10 * scale);
          BOOST_TEST(max_difference(of_curvature.tension, block(1, 0) * y) < 1e-10 * scale);
          BOOST_TEST(max_difference(of_tension.shape, block(0, 1) * y) < 1e-10 * scale);
          BOOST_TEST(max_difference(of_tension.tension, block(1, 1) * y) < 1e-10 * scale);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(solution_satisfies_the_coupled_system) {
  const Model model = stiff_model();
  const Space space(kOrder);
  const Membrane membrane = make_membrane(space, asymmetric_shape(kOrder), kStokesLayer);
  const FlowScalars rhs{smooth_coefficients(kOrder, 6, 1, 101), smooth_coefficients(kOrder, 6, 1, 102)};
  StepSystem system(model, membrane);
  const FlowSystem::Solution solution = system.solve(rhs, 1e-11);
  const FlowScalars reached = system.left_side(solution.unknowns.front());
  BOOST_TEST(solution.report.converged());
  BOOST_TEST(max_difference(reached.shape, rhs.shape) < 1e-8);
  BOOST_TEST(max_difference(reached.tension, rhs.tension) < 1e-8);
}

BOOST_AUTO_TEST_CASE(preconditioner_is_the_inverse_on_a_sphere) {
  const Model model = stiff_model();
  const Space space(kOrder);
  const Membrane membrane = make_membrane(space, sphere(kOrder), kStokesLayer);
  FlowScalars rhs{smooth_coefficients(kOrder, 6, 1, 103), smooth_coefficients(kOrder, 6, 1, 104)};
  rhs.tension[0] = 0.0;
  const SolveReport report = StepSystem(model, membrane, kDt).solve(rhs, 1e-8).report;
  BOOST_TEST(report.converged());
  BOOST_TEST(report.iterations <= 2);
}

BOOST_AUTO_TEST_CASE(iterations_are_bounded_from_soft_to_stiff_steps) {
  const Space space(kOrder);
  const Membrane membrane = make_membrane(space, asymmetric_shape(kOrder), kStokesLayer);
  const FlowScalars rhs{smooth_coefficients(kOrder, 6, 1, 105), smooth_coefficients(kOrder, 6, 1, 106)};
  for (const double modulus : {1e-3, 1.0, 10.0}) {
    const Model model = relaxation_model(modulus);
    const SolveReport report = StepSystem(model, membrane, kDt).solve(rhs, 1e-9).report;
    BOOST_TEST_CONTEXT("bending modulus " << modulus) {
      BOOST_TEST(report.converged());
      BOOST_TEST(report.iterations <= 100);
    }
  }
}

BOOST_AUTO_TEST_CASE(iterations_are_bounded_at_every_viscosity_ratio) {
  const Space space(kOrder);
  const FlowScalars rhs{smooth_coefficients(kOrder, 6, 1, 107), smooth_coefficients(kOrder, 6, 1, 108)};
  Model model = shear_model();
  for (const double ratio : {1e-3, 1.0, 1e3}) {
    model.vesicles[0].viscosity_ratio = ratio;
    const Membrane membrane = make_membrane(space, ellipsoid(kOrder, {2.0, 1.0, 0.9}), kStokesLayers, ratio);
    const std::vector<FlowMembrane> alone{{parameters_of(model), membrane}};
    const Interaction none;
    MembraneFlow flow(alone, none);
    const SolveReport of_state =
        solve_tensions(alone, {false}, flow, {Matrix()}, {smooth_coefficients(kOrder, 6, 3, 108)}, {Vector()},
                       {RecycledSubspace{}}, 1e-9)
            .report;
    const SolveReport of_step = StepSystem(model, membrane, kDt).solve(rhs, 1e-9).report;
    for (const SolveReport& report : {of_state, of_step}) {
      BOOST_TEST_CONTEXT("viscosity ratio " << ratio) {
        BOOST_TEST(report.converged());
        BOOST_TEST(report.iterations <= 40);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rough_solve_takes_few_iterations_at_every_degree_and_stiffness) {
  // Each pass of a step is solved to two digits.
  constexpr double kPassTolerance = 1e-2;
  for (const int order : {8, 16}) {
    const Space space(order);
    const Membrane membrane = make_membrane(space, asymmetric_shape(order), kStokesLayer);
    const FlowScalars rhs{smooth_coefficients(order, 6, 1, 111), smooth_coefficients(order, 6, 1, 112)};
    for (const double stiffness : {1e-4, 1e-2, 1.0, 10.0}) {
      const Model model = relaxation_model(stiffness);
      const SolveReport report = StepSystem(model, membrane, 1.0).solve(rhs, kPassTolerance).report;
      BOOST_TEST_CONTEXT("degree " << order << ", bending modulus times dt " << stiffness) {
        BOOST_TEST(report.converged());
        BOOST_TEST(report.iterations <= 12);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(subspaces_are_reused_for_other_shapes_and_steps) {
  const Model model = stiff_model();
  const Space space(kOrder);
  const Matrix shape = asymmetric_shape(kOrder);
  const Membrane former = make_membrane(space, shape, kStokesLayer);
  const Membrane membrane = make_membrane(space, 1.001 * shape, kStokesLayer);
  FlowScalars rhs{smooth_coefficients(kOrder, 6, 1, 133), smooth_coefficients(kOrder, 6, 1, 134)};
  StepSystem system(model, former);
  system.solve(rhs, 1e-9);
  rhs.shape += 1e-3 * smooth_coefficients(kOrder, 6, 1, 135);
  for (const double dt : {0.8 * kDt, kDt, 1.25 * kDt}) {
    const FlowSystem::Solution cold = StepSystem(model, membrane, dt).solve(rhs, 1e-5);
    const FlowSystem::Solution warm = StepSystem(model, membrane, dt, system.found()).solve(rhs, 1e-5);
    BOOST_TEST_CONTEXT("dt " << dt) {
      BOOST_TEST(warm.report.iterations < cold.report.iterations);
      BOOST_TEST(max_difference(warm.unknowns.front().shape, cold.unknowns.front().shape) <
                 1e-3 * cold.unknowns.front().shape.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_subspace_of_a_system_solves_it_again) {
  const Model model = stiff_model();
  const Space space(kOrder);
  const Membrane membrane = make_membrane(space, asymmetric_shape(kOrder), kStokesLayer);
  const FlowScalars rhs{smooth_coefficients(kOrder, 6, 1, 133), smooth_coefficients(kOrder, 6, 1, 134)};
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
    StepSystem system(model, membrane);
    const FlowSystem::Solution cold = system.solve(rhs, tolerance);
    const FlowSystem::Solution warm = StepSystem(model, membrane, kDt, system.found()).solve(rhs, tolerance);
    BOOST_TEST_CONTEXT("tolerance " << tolerance) {
      BOOST_TEST(cold.report.iterations > 2);
      BOOST_TEST(warm.report.iterations <= 2);
    }
  }
}

BOOST_AUTO_TEST_CASE(subspaces_of_another_degree_are_dropped) {
  const Model model = stiff_model();
  const Space space(kOrder), other(kOrder + 2);
  const Membrane membrane = make_membrane(space, asymmetric_shape(kOrder), kStokesLayer);
  StepSystem system(model, membrane);
  system.solve({smooth_coefficients(kOrder, 6, 1, 136), smooth_coefficients(kOrder, 6, 1, 137)}, 1e-3);
  const Membrane finer = make_membrane(other, asymmetric_shape(kOrder + 2), kStokesLayer);
  BOOST_TEST(StepSystem(model, membrane, kDt, system.found()).kept().count() > 0);
  BOOST_TEST(StepSystem(model, finer, kDt, system.found()).kept().count() == 0);
}

BOOST_AUTO_TEST_CASE(recycled_responses_are_those_of_the_membrane) {
  const Model model = stiff_model();
  const Space space(kOrder);
  const Membrane membrane = make_membrane(space, asymmetric_shape(kOrder), kStokesLayer);
  StepSystem system(model, membrane);
  system.solve({smooth_coefficients(kOrder, 6, 1, 141), smooth_coefficients(kOrder, 6, 1, 142)}, 1e-3);
  const RecycledSubspace found = system.found();
  const Index n = found.arguments.rows() / 2;
  BOOST_TEST_REQUIRE(found.count() > 2);
  for (Index j = 0; j < found.count(); ++j) {
    const FlowScalars unknowns{found.arguments.col(j).head(n), found.arguments.col(j).tail(n)};
    const SphereDerivatives u = membrane.fine.synthesize_derivatives(system.velocity(unknowns));
    const Vector divergence = weighted_divergence(membrane, u);
    const Vector curvature = curvature_increment(membrane, membrane.fine, u);
    const Matrix& responses = found.responses;
    BOOST_TEST(max_difference(responses.col(j).head(n), curvature) < 1e-9 * curvature.norm());
    BOOST_TEST(max_difference(responses.col(j).tail(n), divergence) < 1e-9 * divergence.norm());
  }
}

BOOST_AUTO_TEST_CASE(velocity_of_a_solution_is_that_of_its_unknowns) {
  const Model model = stiff_model();
  const Space space(kOrder);
  const Membrane membrane = make_membrane(space, asymmetric_shape(kOrder), kStokesLayer);
  StepSystem system(model, membrane);
  for (const int seed : {121, 123}) {
    const FlowScalars rhs{smooth_coefficients(kOrder, 6, 1, seed), smooth_coefficients(kOrder, 6, 1, seed + 1)};
    const FlowSystem::Solution solution = system.solve(rhs, 1e-6);
    const Matrix expected = system.velocity(solution.unknowns.front());
    BOOST_TEST((solution.velocities.front() - expected).norm() < 1e-11 * expected.norm());
  }
}

BOOST_AUTO_TEST_SUITE_END()
