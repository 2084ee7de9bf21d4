#include <boost/test/unit_test.hpp>

#include "fem_check/inextensible_flow.hpp"
#include "meshes/box_mesh.hpp"
#include "tests/fem_check/cases.hpp"
#include "tests/meshes/two_shapes.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

namespace {

using Shapes = std::array<vehd::meshes::FrozenShape, 2>;

struct TwoMesh {
  int cells_per_edge = 2;
  int degree = 5;
  double outer_radius = 12.0;
};

Discretisation discretise(const Shapes& shapes, const TwoMesh& level) {
  vehd::meshes::BoxMeshOptions options;
  options.cells_per_edge = level.cells_per_edge;
  options.boxes.outer_radius = level.outer_radius;
  return {std::make_shared<vehd::meshes::BoxMesh>(vehd::meshes::make_two_vesicle_mesh(shapes, options)), level.degree};
}

Shapes two_spheres(double gap) {
  const auto sphere = [](double z) {
    return vehd::meshes::FrozenShape(shapes::project(
        1, [z](const vehd::meshes::Point& r) { return vehd::meshes::Point(r + z * Vector3::UnitZ()); }));
  };
  return {sphere(-1.0 - 0.5 * gap), sphere(1.0 + 0.5 * gap)};
}

/// Integral over the membrane of one vesicle.
Vector3 integral(const SurfacePoints& points, const Vectors& field, int vesicle) {
  Vector3 result = Vector3::Zero();
  for (const Eigen::Index i : points.of_vesicle(vesicle)) result += points.weight[i] * field.col(i);
  return result;
}

/// Error on the membrane of one vesicle.
double error_on(const SurfacePoints& points, const Eigen::MatrixXd& found, const Eigen::MatrixXd& exact, int vesicle) {
  const std::vector<Eigen::Index> own = points.of_vesicle(vesicle);
  return relative_l2(points.picked(own), found(Eigen::all, own), exact(Eigen::all, own));
}

/// Inside either vesicle, the potential of a source elsewhere; outside, that of sources in both.
struct SourcesOfTwo {
  std::array<PointSource, 2> inner_field;  ///< one for each inside
  std::array<PointSource, 2> outer_field;  ///< one in each
  std::vector<double> conductivity_in;
  double conductivity_out = 1.0;
  std::vector<double> permittivity_in;

  [[nodiscard]] double outside(const Vector3& x) const { return outer_field[0].value(x) + outer_field[1].value(x); }
  [[nodiscard]] Vector3 gradient_outside(const Vector3& x) const {
    return outer_field[0].gradient(x) + outer_field[1].gradient(x);
  }
  /// Values as row vectors [1 x points].
  template <typename OfPoint>
  [[nodiscard]] static Eigen::MatrixXd at(const SurfacePoints& points, const OfPoint& of_point) {
    Eigen::MatrixXd result(of_point(Vector3(Vector3::UnitX()), Vector3(Vector3::UnitX()), 0).size(), points.size());
    for (Eigen::Index i = 0; i < points.size(); ++i) {
      result.col(i) = of_point(Vector3(points.position.col(i)), Vector3(points.normal.col(i)), points.vesicle[i]);
    }
    return result;
  }
  [[nodiscard]] Eigen::MatrixXd jump(const SurfacePoints& points) const {
    return at(points, [&](const Vector3& x, const Vector3&, int vesicle) {
      return Vector(Vector::Constant(1, inner_field[vesicle].value(x) - outside(x)));
    });
  }
  [[nodiscard]] Eigen::MatrixXd flux_in(const SurfacePoints& points) const {
    return at(points, [&](const Vector3& x, const Vector3& n, int vesicle) {
      return Vector(Vector::Constant(1, n.dot(inner_field[vesicle].gradient(x))));
    });
  }
  [[nodiscard]] Eigen::MatrixXd charge(const SurfacePoints& points) const {
    return at(points, [&](const Vector3& x, const Vector3& n, int vesicle) {
      return Vector(Vector::Constant(1, n.dot(inner_field[vesicle].gradient(x) - gradient_outside(x))));
    });
  }
  [[nodiscard]] Eigen::MatrixXd force(const SurfacePoints& points) const {
    return at(points, [&](const Vector3& x, const Vector3& n, int vesicle) {
      const auto stress = [&](double permittivity, const Vector3& field) {
        return Vector(permittivity * (field.dot(n) * field - 0.5 * field.squaredNorm() * n));
      };
      return Vector(stress(permittivity_in[vesicle], inner_field[vesicle].gradient(x)) -
                    stress(1.0, gradient_outside(x)));
    });
  }
  [[nodiscard]] PotentialProblem problem() const {
    PotentialProblem result;
    result.conductivity_in = conductivity_in;
    result.conductivity_out = conductivity_out;
    result.permittivity_in = permittivity_in;
    result.membrane = PrescribedJump{[*this](const SurfacePoints& points) { return Vector(jump(points).row(0)); }};
    result.current_jump = [*this](const SurfacePoints& points) {
      return Vector(at(points, [&](const Vector3& x, const Vector3& n, int vesicle) {
                      return Vector(
                          Vector::Constant(1, n.dot(conductivity_in[vesicle] * inner_field[vesicle].gradient(x) -
                                                    conductivity_out * gradient_outside(x))));
                    }).row(0));
    };
    result.outer.kind = OuterCondition::Kind::dirichlet;
    result.outer.value = [*this](const Vector3& x) { return outside(x); };
    return result;
  }
};

SourcesOfTwo sources_in(const Shapes& shapes) {
  const Vector3 first = shapes[0].centroid(), second = shapes[1].centroid();
  return {{{{second + Vector3(0.1, 0.1, 0.0), 4.0}, {first - Vector3(0.0, 0.2, 0.1), -3.0}}},
          {{{first + Vector3(0.1, -0.1, 0.2), 1.0}, {second + Vector3(-0.1, 0.1, 0.05), 2.0}}},
          {2.5, 0.3},
          1.0,
          {1.7, 0.4}};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(two_vesicles)

BOOST_AUTO_TEST_CASE(sources_in_both_vesicles_are_found_with_materials_of_their_own) {
  for (const auto& [gap, bound] : {std::pair(1.0, 5e-4), std::pair(0.2, 3e-3)}) {
    const Shapes shapes = shapes::two_shapes(gap);
    const Discretisation space = discretise(shapes, {});
    const SurfacePoints points = space.quadrature_points(8);
    const SourcesOfTwo exact = sources_in(shapes);
    PotentialProblem problem = exact.problem();
    const PotentialSolution solution = solve_potential(space, problem);
    const PotentialTraces traces = solution.on_surface(points);
    const double step = 0.2;
    const std::vector<double> capacitance{1.5, 0.5}, conductance{0.3, 2.0};
    problem.membrane = ChargingMembrane{capacitance, conductance, step, 1, [&](const SurfacePoints& at) {
                                          Vector before = exact.jump(at).row(0);
                                          const Eigen::MatrixXd flux = exact.flux_in(at);
                                          for (Eigen::Index i = 0; i < at.size(); ++i) {
                                            const int k = at.vesicle[i];
                                            const double current =
                                                exact.conductivity_in[k] * flux(0, i) + conductance[k] * before[i];
                                            before[i] += step / capacitance[k] * current;
                                          }
                                          return before;
                                        }};
    const Vector charged = solve_potential(space, problem).on_surface(points).transmembrane_potential;
    for (int vesicle = 0; vesicle < 2; ++vesicle) {
      const double charge = error_on(points, traces.charge.transpose(), exact.charge(points), vesicle);
      const double force = error_on(points, traces.force, exact.force(points), vesicle);
      const double voltage = error_on(points, charged.transpose(), exact.jump(points), vesicle);
      BOOST_TEST_MESSAGE("gap " << gap << ", vesicle " << vesicle << ": q " << charge << ", f_E " << force << ", V_m "
                                << voltage << " with " << space.n_nodes() << " unknowns");
      BOOST_TEST_CONTEXT("gap " << gap << ", vesicle " << vesicle) {
        BOOST_TEST(charge < bound);
        BOOST_TEST(force < 3.0 * bound);
        BOOST_TEST(voltage < 0.3 * bound);
      }
      Vectors inside(3, 1);
      inside.col(0) = shapes[vesicle].centroid() + Vector3(0.2, -0.1, 0.1);
      const double value = solution.potential(space.locate(inside))[0];
      BOOST_TEST(std::abs(value / exact.inner_field[vesicle].value(inside.col(0)) - 1.0) < bound);
    }
  }
}

// Forces over ε a² E² of the field on two spheres at the gap a/2, from linear systems of their multipoles.
BOOST_AUTO_TEST_CASE(spheres_in_a_field_attract_and_repel_as_their_multipoles_do) {
  const Discretisation space = discretise(two_spheres(0.5), {});
  const SurfacePoints points = space.quadrature_points(8);
  struct Case {
    Vector3 field;
    bool conducting;
    double force;  ///< on the lower sphere, upwards
  };
  for (const Case& c : {Case{Vector3::UnitZ(), false, 0.3795307307}, Case{Vector3::UnitX(), false, -0.2839306118},
                        Case{Vector3::UnitZ(), true, 3.173019487}, Case{Vector3::UnitX(), true, -0.7590614615}}) {
    PotentialProblem problem;
    problem.field = c.field;
    problem.conductivity_in = 0.7;
    problem.membrane = SteadyMembrane{0.0, {std::vector<double>{0.0, 0.3}}};
    if (c.conducting) {
      problem.conductivity_in = 1e7;
      problem.membrane = PrescribedJump{on_surface([](const Vector3&, const Vector3&) { return 0.0; })};
    }
    const PotentialTraces traces = solve_potential(space, problem).on_surface(points);
    const Vector3 lower = -integral(points, traces.force, 0), upper = -integral(points, traces.force, 1);
    BOOST_TEST_MESSAGE("exact " << c.force << ", lower " << lower.transpose() << ", upper " << upper.transpose());
    BOOST_TEST_CONTEXT("along (" << c.field.transpose() << "), conducting: " << c.conducting) {
      BOOST_TEST(std::abs(lower.z() - c.force) < 3e-4 * std::abs(c.force));
      BOOST_TEST((lower + upper).norm() < 3e-4 * std::abs(c.force));
      if (!c.conducting) {
        double mean = 0.0, area = 0.0;
        for (const Eigen::Index i : points.of_vesicle(1)) {
          mean += points.weight[i] * traces.transmembrane_potential[i];
          area += points.weight[i];
        }
        BOOST_TEST(std::abs(mean / area - 0.3) < 1e-6);
      }
    }
  }
}

// At equal viscosities the flows of forces on both spheres add up: a uniform force causes a Stokeslet with a source
// doublet, a torque a rotlet.
BOOST_AUTO_TEST_CASE(flows_of_forces_and_torques_on_two_spheres_add_up) {
  const Shapes shapes = two_spheres(0.5);
  const Discretisation space = discretise(shapes, {.degree = 4});
  const SurfacePoints points = space.quadrature_points(8);
  const Vector3 force(0.3, -0.7, 1.0), torque(0.5, 0.2, -0.4);
  constexpr double pi = std::numbers::pi;
  const auto stokeslet = [&](const Vector3& r) {
    const double a = std::max(1.0, r.norm());  // inside it is the flow of the surface
    const Vector3 n = r.norm() > 1.0 ? Vector3(r / a) : Vector3(Vector3::Zero());
    if (r.norm() <= 1.0) return Vector3(force / (6.0 * pi));
    return Vector3((force + n.dot(force) * n) / (8.0 * pi * a) +
                   (force - 3.0 * n.dot(force) * n) / (24.0 * pi * a * a * a));
  };
  const auto rotlet = [&](const Vector3& r) {
    return Vector3(torque.cross(r) / (8.0 * pi * std::pow(std::max(1.0, r.norm()), 3)));
  };
  FlowProblem problem;
  problem.force = [&](const SurfacePoints& at) {
    return Vectors(SourcesOfTwo::at(at, [&](const Vector3&, const Vector3& n, int vesicle) {
      return Vector(vesicle == 0 ? Vector3(force / (4.0 * pi)) : Vector3(3.0 / (8.0 * pi) * torque.cross(n)));
    }));
  };
  const FlowSolution solution = solve_flow(space, problem);
  const Vectors exact = sampled_vectors(points, [&](const Vector3& x, const Vector3&) {
    return Vector3(stokeslet(x - shapes[0].centroid()) + rotlet(x - shapes[1].centroid()));
  });
  const Vectors found = solution.on_surface(points).velocity;
  for (int vesicle = 0; vesicle < 2; ++vesicle) {
    const double error = error_on(points, found, exact, vesicle);
    BOOST_TEST_MESSAGE("flow on sphere " << vesicle << ": " << error);
    BOOST_TEST(error < 1e-3);
  }
}

// Stimson and Jeffery: equal spheres along their line of centres at the gap a/2 move with F = 6πμaUλ.
BOOST_AUTO_TEST_CASE(stiff_spheres_move_together_and_apart_as_rigid_ones) {
  const Discretisation space = discretise(two_spheres(0.5), {.degree = 4});
  const SurfacePoints points = space.quadrature_points(8);
  constexpr double pi = std::numbers::pi;
  for (const auto& [sign, resistance] : {std::pair(1.0, 0.672915513765), std::pair(-1.0, 2.77241867956)}) {
    FlowProblem problem;
    problem.viscosity_in = std::vector{1e6, 1e5};
    problem.force = [&, sign = sign](const SurfacePoints& at) {
      return Vectors(SourcesOfTwo::at(at, [&](const Vector3&, const Vector3&, int vesicle) {
        return Vector((vesicle == 0 ? 1.0 : sign) / (4.0 * pi) * Vector3::UnitZ());
      }));
    };
    const FlowSolution solution = solve_flow(space, problem);
    const Vectors found = solution.on_surface(points).velocity;
    const double speed = 1.0 / (6.0 * pi * resistance);
    BOOST_TEST_MESSAGE("λ " << resistance << ": " << integral(points, found, 0).z() / (4.0 * pi) / speed << " after "
                            << solution.cost().iterations << " iterations");
    for (int vesicle = 0; vesicle < 2; ++vesicle) {
      Vectors exact = Vectors::Zero(3, points.size());
      exact.row(2).setConstant(vesicle == 0 ? speed : sign * speed);
      BOOST_TEST(error_on(points, found, exact, vesicle) < 2e-3);
    }
  }
}

// v = A x solves the Stokes equations in fluids of any viscosity if the membrane force balances the jump of stress.
BOOST_AUTO_TEST_CASE(linear_flow_passes_through_vesicles_of_other_viscosities) {
  const Shapes shapes = shapes::two_shapes(0.2);
  const Discretisation space = discretise(shapes, {.degree = 3});
  const SurfacePoints points = space.quadrature_points(6);
  Matrix3 gradient;
  gradient << 0.3, 0.5, -0.2, 0.1, 0.1, 0.4, -0.6, 0.2, -0.4;
  FlowProblem problem;
  problem.gradient = gradient;
  const std::vector<double> viscosity{3.0, 0.2};
  problem.viscosity_in = viscosity;
  problem.force = [&](const SurfacePoints& at) {
    return Vectors(SourcesOfTwo::at(at, [&](const Vector3&, const Vector3& n, int vesicle) {
      return Vector((viscosity[vesicle] - 1.0) * (gradient + gradient.transpose()) * n);
    }));
  };
  const Vectors found = solve_flow(space, problem).on_surface(points).velocity;
  BOOST_TEST(relative_l2(points, found, gradient * points.position) < 1e-6);
}

BOOST_AUTO_TEST_CASE(tensions_of_two_are_refused) {
  FlowProblem problem;
  problem.force = vectors_on_surface([](const Vector3&, const Vector3& n) { return n; });
  BOOST_CHECK_THROW(solve_inextensible_flow(discretise(two_spheres(1.0), {.degree = 2}), problem),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
