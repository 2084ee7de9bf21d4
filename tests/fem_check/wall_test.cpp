#include <boost/test/unit_test.hpp>
#include <limits>

#include "meshes/box_mesh.hpp"
#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(beside_wall)

namespace {

using meshes::Wall;
constexpr double pi = std::numbers::pi;

/// Arbitrary wall normal.
const Vector3 kNormal = Vector3(1.0, -2.0, 0.5).normalized();

struct WallMesh {
  int cells_per_edge = 2;
  int degree = 4;
  double outer_radius = 8.0;
};

Discretisation discretise(const meshes::FrozenShape& shape, const Wall& wall, const WallMesh& level) {
  meshes::BoxMeshOptions options;
  options.cells_per_edge = level.cells_per_edge;
  options.boxes.outer_radius = level.outer_radius;
  return {std::make_shared<meshes::BoxMesh>(meshes::make_mesh_beside_wall(shape, wall, options)), level.degree};
}

/// Wall at this gap from a shape.
Wall wall_at(const meshes::FrozenShape& shape, double gap) {
  double lowest = std::numeric_limits<double>::max();
  shapes::for_each_sphere_point(
      120, [&](const Vector3& r, double) { lowest = std::min(lowest, kNormal.dot(shape.position(r))); });
  return {(lowest - gap) * kNormal, kNormal};
}

/// Wall at this gap from the unit sphere about the origin.
Wall wall_below_sphere(double gap) { return {-(1.0 + gap) * kNormal, kNormal}; }

Vector3 image_of(const Vector3& x, const Wall& wall) { return x - 2.0 * wall.normal.dot(x - wall.point) * wall.normal; }

Vector3 integral(const SurfacePoints& points, const Vectors& field) { return field * points.weight; }

/// Inside, the potential of a source outside; outside, that of a source in the vesicle and of its image.
struct SourceBesideWall {
  PointSource inner_field;
  std::array<PointSource, 2> outer_field;

  SourceBesideWall(const PointSource& outside, const PointSource& inside, const Wall& wall, WallField condition)
      : inner_field(outside),
        outer_field{inside, PointSource{image_of(inside.position, wall),
                                        condition == WallField::electrode ? -inside.strength : inside.strength}} {}

  [[nodiscard]] double outside(const Vector3& x) const { return outer_field[0].value(x) + outer_field[1].value(x); }
  [[nodiscard]] Vector3 gradient_outside(const Vector3& x) const {
    return outer_field[0].gradient(x) + outer_field[1].gradient(x);
  }
  [[nodiscard]] PotentialProblem problem(WallField condition) const {
    PotentialProblem result;
    result.conductivity_in = 1.0;
    result.conductivity_out = 2.0;
    result.membrane = PrescribedJump{
        on_surface([*this](const Vector3& x, const Vector3&) { return inner_field.value(x) - outside(x); })};
    result.current_jump = on_surface([*this](const Vector3& x, const Vector3& n) {
      return n.dot(inner_field.gradient(x) - 2.0 * gradient_outside(x));
    });
    result.wall = condition;
    return result;
  }
};

/// 8πμ times the velocity of a point force f at y above a no-slip wall, by its image (Blake 1971).
Vector3 blake(const Vector3& x, const Vector3& y, const Vector3& f, const Wall& wall) {
  const Vector3& n = wall.normal;
  const double h = n.dot(y - wall.point), z = n.dot(x - wall.point), f_n = n.dot(f);
  const Vector3 along = f - f_n * n, r = x - y, s = x - image_of(y, wall), image_force = f_n * n - along;
  const double a = r.norm(), b = s.norm(), b3 = b * b * b;
  const Vector3 g = along - f_n * n;
  const double potential = 2.0 * f_n / b - 2.0 * h * g.dot(s) / b3;
  const Vector3 slope = -2.0 * f_n / b3 * s - 2.0 * h * (g / b3 - 3.0 * g.dot(s) / (b3 * b * b) * s);
  return f / a + r.dot(f) / (a * a * a) * r + image_force / b + s.dot(image_force) / b3 * s + z * slope - potential * n;
}

}  // namespace

BOOST_AUTO_TEST_CASE(sources_and_their_images_are_found_with_the_order_of_the_elements) {
  const meshes::FrozenShape shape = shapes::asymmetric();
  const Wall wall = wall_at(shape, 0.3);
  const PointSource outside{shape.centroid() + Vector3(1.5, -1.2, 2.5), 10.0};
  const PointSource inside{shape.centroid() + Vector3(0.1, 0.2, 0.05), 1.0};
  for (const WallField condition : {WallField::insulating, WallField::electrode}) {
    const SourceBesideWall exact(outside, inside, wall, condition);
    std::vector<double> errors;
    for (const int degree : {3, 4, 5}) {
      const Discretisation space = discretise(shape, wall, {.degree = degree});
      const SurfacePoints points = space.quadrature_points(8);
      const PotentialSolution solution = solve_potential(space, exact.problem(condition));
      const Vector charge = sampled(points, [&](const Vector3& x, const Vector3& n) {
        return n.dot(exact.inner_field.gradient(x) - exact.gradient_outside(x));
      });
      errors.push_back(relative_l2(points, solution.on_surface(points).charge, charge));
      Vectors place(3, 1);
      place.col(0) = shape.centroid() + 0.5 * kNormal + 2.5 * kNormal.unitOrthogonal();
      const double value = solution.potential(space.locate(place))[0];
      BOOST_TEST_MESSAGE("degree " << degree << ": q " << errors.back() << ", φ "
                                   << value / exact.outside(place.col(0)) - 1.0);
    }
    BOOST_TEST(errors[1] < 0.6 * errors[0]);
    BOOST_TEST(errors[2] < 0.6 * errors[1]);
    BOOST_TEST(errors[2] < 3e-3);
  }
}

// Forces over ε a² E² of the field on two spheres at the gap a/2, from linear systems of their multipoles. The gap to
// the wall is half of that.
BOOST_AUTO_TEST_CASE(sphere_beside_a_wall_feels_the_force_of_its_mirror_image) {
  const Wall wall = wall_below_sphere(0.25);
  const Discretisation space = discretise(unit_sphere(), wall, {.degree = 5});
  const SurfacePoints points = space.quadrature_points(8);
  struct Case {
    WallField wall;
    bool conducting;
    double force;  ///< towards the wall
  };
  for (const Case& c :
       {Case{WallField::electrode, false, 0.3795307307}, Case{WallField::insulating, false, -0.2839306118},
        Case{WallField::electrode, true, 3.173019487}, Case{WallField::insulating, true, -0.7590614615}}) {
    PotentialProblem problem;
    problem.wall = c.wall;
    problem.field = c.wall == WallField::electrode ? kNormal : Vector3(kNormal.unitOrthogonal());
    problem.conductivity_in = 0.7;
    problem.membrane = SteadyMembrane{0.0, 0.0};
    if (c.conducting) {
      problem.conductivity_in = 1e7;
      problem.membrane = PrescribedJump{on_surface([](const Vector3&, const Vector3&) { return 0.0; })};
    }
    const Vector3 force = -integral(points, solve_potential(space, problem).on_surface(points).force);
    BOOST_TEST_MESSAGE("exact " << c.force << ", found " << -kNormal.dot(force));
    BOOST_TEST_CONTEXT("electrode: " << (c.wall == WallField::electrode) << ", conducting: " << c.conducting) {
      BOOST_TEST(std::abs(-kNormal.dot(force) - c.force) < 3e-4 * std::abs(c.force));
      BOOST_TEST((force - kNormal.dot(force) * kNormal).norm() < 3e-4 * std::abs(c.force));
    }
  }
}

// With equal viscosities, forces on γ cause the flow of point forces and their images.
BOOST_AUTO_TEST_CASE(flow_of_forces_is_that_of_point_forces_with_their_images) {
  const meshes::FrozenShape shape = shapes::asymmetric();
  const Wall wall = wall_at(shape, 0.3);
  FlowProblem problem;
  problem.force = vectors_on_surface(
      [](const Vector3& x, const Vector3& n) { return Vector3(x.z() * n + Vector3(0.5, x.x() * x.y(), -0.3)); });
  Vectors places(3, 4);
  places.col(0) = shape.centroid();
  places.col(1) = shape.centroid() + 2.5 * kNormal;
  places.col(2) = shape.centroid() + 2.2 * kNormal.unitOrthogonal();
  places.col(3) = places.col(2) - 1.2 * kNormal;
  for (const WallFlow condition : {WallFlow::no_slip, WallFlow::stress_free}) {
    problem.wall = condition;
    std::vector<double> errors;
    for (const int degree : {3, 4, 5}) {
      const Discretisation space = discretise(shape, wall, {.degree = degree});
      const SurfacePoints points = space.quadrature_points(14);
      const Vectors force = problem.force(points);
      Vectors exact = Vectors::Zero(3, places.cols());
      for (Eigen::Index i = 0; i < places.cols(); ++i) {
        for (Eigen::Index q = 0; q < points.size(); ++q) {
          const Vector3 x = places.col(i), y = points.position.col(q), f = points.weight[q] * force.col(q);
          const auto of_point = [&](const Vector3& at, const Vector3& strength) {
            const Vector3 r = x - at;
            return Vector3(strength / r.norm() + r.dot(strength) / std::pow(r.norm(), 3) * r);
          };
          exact.col(i) +=
              condition == WallFlow::no_slip
                  ? blake(x, y, f, wall)
                  : Vector3(of_point(y, f) + of_point(image_of(y, wall), f - 2.0 * kNormal.dot(f) * kNormal));
        }
      }
      exact /= 8.0 * pi;
      const FlowSolution solution = solve_flow(space, problem);
      errors.push_back((solution.velocity(space.locate(places)) - exact).norm() / exact.norm());
      BOOST_TEST_MESSAGE("degree " << degree << ": v " << errors.back() << " after " << solution.cost().iterations
                                   << " iterations");
    }
    BOOST_TEST(errors[1] < 0.8 * errors[0]);
    BOOST_TEST(errors[2] < 0.5 * errors[1]);
    BOOST_TEST(errors[2] < 1e-3);
  }
}

// Brenner 1961: forces over 6πμaU towards a no-slip wall. Stimson and Jeffery's value for spheres approaching each
// other applies to a stress-free wall.
BOOST_AUTO_TEST_CASE(stiff_spheres_move_towards_a_wall_as_rigid_ones) {
  struct Case {
    WallFlow wall;
    double gap, resistance, bound;
  };
  for (const Case& c :
       {Case{WallFlow::no_slip, 1.0, 2.12553557, 1e-3}, Case{WallFlow::no_slip, 0.5430806, 3.03606451, 1e-3},
        Case{WallFlow::no_slip, 0.1, 11.45915720, 3e-3}, Case{WallFlow::no_slip, 4.0, 1.28508656, 1e-3},
        Case{WallFlow::stress_free, 0.25, 2.77241867956, 1e-3}}) {
    const Wall wall = wall_below_sphere(c.gap);
    const Discretisation space =
        discretise(unit_sphere(), wall, {.degree = 5, .outer_radius = std::max(8.0, 3.0 * (c.gap + 2.0))});
    const SurfacePoints points = space.quadrature_points(8);
    FlowProblem problem;
    problem.wall = c.wall;
    problem.viscosity_in = 1e6;
    problem.force = vectors_on_surface([](const Vector3&, const Vector3&) { return Vector3(-kNormal / (4.0 * pi)); });
    const FlowSolution solution = solve_flow(space, problem);
    const Vectors found = solution.on_surface(points).velocity;
    const Vectors exact = (-kNormal / (6.0 * pi * c.resistance)).replicate(1, points.size());
    BOOST_TEST_MESSAGE("gap " << c.gap << ": " << relative_l2(points, found, exact) << " after "
                              << solution.cost().iterations << " iterations");
    BOOST_TEST(relative_l2(points, found, exact) < c.bound, c.gap);
  }
}

// A drop less viscous than the surrounding fluid, beside a stress-free wall and beside its mirror image.
BOOST_AUTO_TEST_CASE(drop_beside_a_stress_free_wall_moves_like_one_of_two) {
  const meshes::FrozenShape shape = shapes::asymmetric();
  const Wall wall = wall_at(shape, 0.3);
  const Matrix3 mirror = Matrix3::Identity() - 2.0 * kNormal * kNormal.transpose();
  // The parametrisation is reversed as well, so that the normal points outwards.
  const meshes::FrozenShape image(shapes::project(
      16, [&](const Vector3& r) { return image_of(shape.position(Vector3(r.x(), r.y(), -r.z())), wall); }));
  const auto force = [](const Vector3& x) { return Vector3(0.5 * x.z() + 0.2, x.x() * x.y(), -0.3); };
  FlowProblem problem;
  problem.viscosity_in = 0.2;
  problem.wall = WallFlow::stress_free;
  problem.force = vectors_on_surface([&](const Vector3& x, const Vector3&) { return force(x); });
  const Discretisation space = discretise(shape, wall, {});
  const Vectors place = (shape.centroid() + 0.2 * kNormal + 2.2 * kNormal.unitOrthogonal()).replicate(1, 1);
  const Vector3 found = solve_flow(space, problem).velocity(space.locate(place));
  problem.force = [&](const SurfacePoints& points) {
    Vectors result(3, points.size());
    for (Eigen::Index i = 0; i < points.size(); ++i) {
      const Vector3 x = points.position.col(i);
      result.col(i) = points.vesicle[i] == 0 ? force(x) : Vector3(mirror * force(image_of(x, wall)));
    }
    return result;
  };
  meshes::BoxMeshOptions options;
  options.cells_per_edge = 2;
  const Discretisation both(std::make_shared<meshes::BoxMesh>(meshes::make_two_vesicle_mesh({shape, image}, options)),
                            4);
  const Vector3 expected = solve_flow(both, problem).velocity(both.locate(place));
  BOOST_TEST_MESSAGE("difference " << (found - expected).norm() / expected.norm());
  BOOST_TEST((found - expected).norm() < 2e-3 * expected.norm());
}

BOOST_AUTO_TEST_CASE(operators_of_another_wall_are_refused) {
  const Discretisation space = discretise(unit_sphere(), wall_below_sphere(1.0), {.degree = 2});
  FlowProblem problem;
  problem.force = vectors_on_surface([](const Vector3&, const Vector3& n) { return n; });
  problem.wall = WallFlow::stress_free;
  BOOST_CHECK_THROW(solve_flow(FlowOperators(space, 1.0, 1.0, WallFlow::no_slip), problem), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
