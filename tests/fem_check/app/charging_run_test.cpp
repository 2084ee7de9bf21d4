#include "fem_check/app/charging_run.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

BOOST_AUTO_TEST_SUITE(charging_run, *boost::unit_test::label("slow"))

namespace {

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

const Vector3 turning(0.2, 0.9, -0.4);  ///< ω of the points of fixed (θ, φ)
constexpr double material_share = 0.4;  ///< fraction of ω with which the membrane rotates
constexpr double begin = 0.5, end = 1.5;

/// Coefficients of the unit sphere whose points have rotated by ω t.
Eigen::MatrixXd turned(double time) {
  const Matrix3 turn = Eigen::AngleAxisd(turning.norm() * time, turning.normalized()).toRotationMatrix();
  return shapes::project(1, [](const vehd::meshes::Point& r) { return r; }) * turn.transpose();
}

/// A rotating sphere, its points faster than its material, with initial V_m = start·x.
CheckInput turning_sphere(const Vector3& start) {
  CheckInput input;
  input.position = turned(end);
  input.physics.conductivity_out = 2.0;
  input.physics.capacitance = 1.5;
  input.physics.conductance = 0.2;
  InTime in_time;
  in_time.begin = begin;
  in_time.potential = turned(begin) * start;
  in_time.intervals = 48;
  in_time.field_times = Vector::LinSpaced(in_time.intervals + 1, begin, end);
  in_time.field = Vector3(0.3, -0.2, 0.9).replicate(1, in_time.intervals + 1);
  in_time.shape_times = Vector::LinSpaced(9, begin, end);
  for (const double time : in_time.shape_times) {
    in_time.positions.push_back(turned(time));
    Eigen::MatrixXd velocity = in_time.positions.back();
    for (Eigen::Index i = 0; i < velocity.rows(); ++i) {
      velocity.row(i) = material_share * turning.cross(Vector3(velocity.row(i).transpose())).transpose();
    }
    in_time.velocities.push_back(velocity);
  }
  input.in_time = in_time;
  return input;
}

/// V_m = a·x with C_m (a' − s ω × a) = −G_m a + κ (3E/2 − a), by Runge–Kutta with many steps.
Vector3 exact_potential(const CheckInput& input, Vector3 a) {
  const Physics& physics = input.physics;
  const double in = physics.conductivity_in, out = physics.conductivity_out, kappa = 2.0 * in * out / (in + 2.0 * out);
  const auto rate = [&](const Vector3& value) {
    return Vector3(material_share * turning.cross(value) +
                   (kappa * (1.5 * input.in_time->field.col(0) - value) - physics.conductance * value) /
                       physics.capacitance);
  };
  constexpr int steps = 200;
  const double dt = (end - begin) / steps;
  for (int n = 0; n < steps; ++n) {
    const Vector3 k1 = rate(a), k2 = rate(a + 0.5 * dt * k1), k3 = rate(a + 0.5 * dt * k2), k4 = rate(a + dt * k3);
    a += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return a;
}

/// A sphere that sinks to an insulating wall, to a gap of 0.2, while its material turns about the normal.
/// @param speed  angle per time by which its points of fixed (θ, φ) turn
CheckInput sinking_sphere(double speed) {
  const Vector3 fall(0.0, 0.0, -0.3), rotation(0.0, 0.0, 0.8);
  CheckInput input;
  input.wall = InputWall{{Vector3::Zero(), Vector3::UnitZ()}, WallFlow::no_slip, WallField::insulating};
  input.physics.conductivity_out = 2.0;
  InTime in_time;
  in_time.begin = begin;
  in_time.intervals = 48;
  in_time.field_times = Vector::LinSpaced(in_time.intervals + 1, begin, end);
  in_time.field = Vector3(0.9, 0.3, 0.0).replicate(1, in_time.intervals + 1);
  in_time.shape_times = Vector::LinSpaced(9, begin, end);
  for (const double time : in_time.shape_times) {
    const Matrix3 turn = Eigen::AngleAxisd(speed * (time - end), Vector3::UnitZ()).toRotationMatrix();
    const Vector3 centre = 1.2 * Vector3::UnitZ() + (time - end) * fall;
    const auto project = [](const auto& field) { return shapes::project(1, field); };
    using vehd::meshes::Point;
    in_time.positions.push_back(project([&](const Point& r) { return Point(turn * r + centre); }));
    in_time.velocities.push_back(project([&](const Point& r) { return Point(rotation.cross(turn * r) + fall); }));
    if (time == begin)
      in_time.potential = project([&](const Point& r) { return Point(turn * r); }) * Vector3(0.2, 0.5, -0.4);
  }
  input.position = in_time.positions.back();
  input.in_time = in_time;
  return input;
}

Refinement coarse() {
  Refinement refinement = Refinement::quick();
  refinement.cells_per_edge = 1;
  refinement.shell_layers = 2;
  return refinement;
}

}  // namespace

BOOST_AUTO_TEST_CASE(potential_rides_on_the_material_of_a_sphere_that_turns) {
  const Vector3 start(0.9, 0.1, -0.4);
  const CheckInput input = turning_sphere(start);
  const Refinement refinement = coarse();
  Meshes meshes({vehd::meshes::FrozenShape(input.position)}, refinement);
  const Discretisation space = meshes.discretise(4);
  const SurfacePoints points = space.quadrature_points(refinement.points_per_edge);
  const ChargingRun run(input, refinement);
  const ShapePath path(*input.in_time);
  const Eigen::MatrixXd exact = exact_potential(input, start).transpose() * points.position;
  std::vector<double> errors;
  for (const int steps : {6, 12, 24}) {
    const Solved solved = run.solve(space, {.steps = steps, .settings = {1e-8}, .path = &path});
    errors.push_back(relative_l2(points, solved.surface.at("Vm"), exact));
  }
  BOOST_TEST_CONTEXT(errors[0] << " " << errors[1] << " " << errors[2]) {
    BOOST_TEST(observed_order(errors[0], errors[1], 2.0) > 1.6);
    BOOST_TEST(observed_order(errors[1], errors[2], 2.0) > 1.6);
    BOOST_TEST(errors[2] < 2e-3);
  }
}

// V_m at a place does not depend on which points of the surface pass it.
BOOST_AUTO_TEST_CASE(potential_of_a_sinking_sphere_does_not_depend_on_its_points) {
  const Refinement refinement = coarse();
  const auto potential_of = [&](double speed, int steps) {
    const CheckInput input = sinking_sphere(speed);
    Meshes meshes({vehd::meshes::FrozenShape(input.position)}, refinement, input.wall->place);
    const ShapePath path(*input.in_time);
    return ChargingRun(input, refinement)
        .solve(meshes.discretise(5), {.steps = steps, .settings = {1e-8}, .path = &path})
        .surface.at("Vm");
  };
  std::vector<double> differences;
  for (const int steps : {6, 12}) {
    const Eigen::MatrixXd fixed = potential_of(0.0, steps);
    differences.push_back((potential_of(0.4, steps) - fixed).norm() / fixed.norm());
  }
  BOOST_TEST_CONTEXT(differences[0] << " " << differences[1]) {
    BOOST_TEST(differences[1] < 0.4 * differences[0]);
    BOOST_TEST(differences[1] < 2e-3);
  }
  // The box on the wall does not turn with the membrane.
  BOOST_CHECK_EXCEPTION(potential_of(1.5, 6), vehd::meshes::MeshError, [](const vehd::meshes::MeshError& error) {
    return std::string(error.what()).starts_with("--from: beside a wall no mesh follows the membrane");
  });
}

BOOST_AUTO_TEST_CASE(steps_have_the_potential_at_the_points_of_their_mesh) {
  const CheckInput input = turning_sphere(Vector3(0.9, 0.1, -0.4));
  const Refinement many = coarse();
  Refinement few = many;
  few.points_per_edge = 1;
  const ChargingRun run(input, many);
  const auto advanced_on = [&](const Refinement& refinement) {
    Meshes meshes({vehd::meshes::FrozenShape(input.position)}, refinement);
    return run.solve(meshes.discretise(4), {.steps = 6, .settings = {1e-10}}).surface.at("Vm");
  };
  const Eigen::MatrixXd with_many = advanced_on(many);
  BOOST_TEST((advanced_on(few) - with_many).norm() < 1e-4 * with_many.norm());
}

BOOST_AUTO_TEST_SUITE_END()
