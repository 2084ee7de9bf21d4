#include "bie/physics/volume_fields.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/kernels/laplace.hpp"
#include "bie/physics/point_sources.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/electric.hpp"
#include "tests/support/point_force.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/targets.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(volume_fields)

namespace {

PotentialSources sources_of(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential) {
  const SecondKindSolution density = solve_density(electric, membrane, potential);
  return {electric.field, potential, conductivity_contrast(electric) * density.weighted};
}

PotentialSamples sample(const Matrix& points, const Matrix& position, const PotentialSources& sources,
                        Side side = Side::interior) {
  Instruments instruments;
  return potential_at(points, side, position, sources, {}, instruments);
}

Matrix velocity(const Matrix& points, const Matrix& position, const VelocitySources& sources) {
  Instruments instruments;
  return velocity_at(points, position, sources, {}, instruments).velocity;
}

const std::vector<PointSource> kSources{{{0.10, -0.08, 0.15}, -1.3, true},
                                        {{0.16, 0.08, -0.09}, 0.6, true},
                                        {{-3.3, -0.7, -2.2}, 0.6, false},
                                        {{0.2, -1.4, 3.7}, 1.1, false}};

struct PointField {
  double potential = 0.0;
  Vector3 field = Vector3::Zero();
};

/// Potential and −∇φ at a point on one side, due to the sources on the other side.
PointField exact_point_field(const Vector3& x, bool inside) {
  PointField result;
  for (const PointSource& source : kSources) {
    if (source.inside == inside) continue;
    const Vector3 r = x - source.position;
    const double potential = kLaplacePrefactor * source.strength / r.norm();
    result.potential += potential;
    result.field += potential / r.squaredNorm() * r;
  }
  return result;
}

/// Shape (33) with the jumps (34) of the sources: V_m prescribed, q from (35) as in Example 1.
struct Example1 {
  Space space;
  Matrix position;
  PotentialSources sources;

  explicit Example1(int order) : space(order), position(shape_33(order)) {
    const Membrane membrane = make_membrane(space, position, kLaplaceLayers);
    const PointSourceFields exact = point_source_fields(kSources, membrane.surface);
    const double eta = conductivity_contrast({Vector3::Zero(), 2.0, 1.0, 1.0});
    sources.transmembrane_potential = space.fine.analyze(exact.potential_in - exact.potential_out);
    const Vector current_jump = (2.0 * exact.flux_in - exact.flux_out) / 3.0;
    const Vector rhs = eta * weighted_hypersingular(membrane, sources.transmembrane_potential) +
                       membrane.surface.area_element.cwiseProduct(current_jump);
    const SecondKindSolution density = solve_second_kind(membrane, eta, rhs, 1e-12);
    require_converged(density.report, "charge density");
    sources.weighted_charge = density.weighted;
  }

  struct Errors {
    double potential = 0.0, field = 0.0;
  };

  /// Largest errors relative to the largest potential and field on that side of the membrane.
  [[nodiscard]] Errors errors(const MembranePoints& points, double height, Side side) const {
    const bool inside = side == Side::interior;
    const PotentialSamples found = sample(points.at_height(height), position, sources, side);
    Errors e;
    PointField scale;
    for (Index i = 0; i < points.position.rows(); ++i) {
      BOOST_TEST((found.side[i] == side));
      const PointField exact = exact_point_field(points.at_height(height).row(i).transpose(), inside);
      const PointField on_membrane = exact_point_field(points.position.row(i).transpose(), inside);
      e.potential = std::max(e.potential, std::abs(found.potential[i] - exact.potential));
      e.field = std::max(e.field, (found.field.row(i).transpose() - exact.field).norm());
      scale.potential = std::max(scale.potential, std::abs(on_membrane.potential));
      scale.field = scale.field.cwiseMax(Vector3::Constant(on_membrane.field.norm()));
    }
    return {e.potential / scale.potential, e.field / scale.field.x()};
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(sphere_in_a_uniform_field_has_the_potential_and_field_of_its_dipole) {
  // φ_i = −a z, φ_e = (b/r³ − E) z with V_m = V cos θ, as derived in electric_sphere.
  constexpr int kOrder = 12;
  const Space space(kOrder);
  const Matrix position = sphere(kOrder);
  const Membrane membrane = make_membrane(space, position, kLaplaceLayers);
  const MembranePoints points = membrane_points(position, scattered_angles(15));
  const double e = 1.3;
  for (const double ratio : {1e-8, 0.5, 1.0, 2.0, 1e8}) {
    const double v = 0.7;
    const ElectricParameters electric{{0.0, 0.0, e}, ratio, 1.0, 1.0};
    const double a = (3.0 * e - 2.0 * v) / (ratio + 2.0);
    const double b = e - v - a;
    const Vector potential = space.fine.analyze(v * membrane.surface.position.col(2));
    const PotentialSources sources = sources_of(electric, membrane, potential);
    for (const double height : heights(0.4)) {
      const Matrix x = points.at_height(height);
      const PotentialSamples found = sample(x, position, sources);
      double error = 0.0;
      for (Index i = 0; i < x.rows(); ++i) {
        const Vector3 p = x.row(i).transpose();
        const double r = p.norm();
        const bool inside = height < 0.0;
        const double exact = inside ? -a * p.z() : (b / (r * r * r) - e) * p.z();
        const Vector3 field =
            inside ? Vector3(0.0, 0.0, a)
                   : Vector3((e - b / (r * r * r)) * Vector3::UnitZ() + 3.0 * b * p.z() / std::pow(r, 5) * p);
        error = std::max({error, std::abs(found.potential[i] - exact) / std::max(1.0, r),
                          (found.field.row(i).transpose() - field).norm()});
      }
      BOOST_TEST(error < 1e-9, "conductivity ratio " << ratio << " height " << height << " error " << error);
    }
  }
}

BOOST_AUTO_TEST_CASE(prolate_holds_a_uniform_field_up_to_the_membrane) {
  constexpr int kOrder = 24;
  const Space space(kOrder);
  const Matrix position = prolate(kOrder);
  const Membrane membrane = make_membrane(space, position, kLaplaceLayers);
  const double field = 1.3;
  const double e = std::sqrt(0.75);
  const double depolarisation = (1.0 - e * e) / (e * e) * (std::atanh(e) / e - 1.0);
  const MembranePoints points = membrane_points(position, scattered_angles(20));
  for (const double ratio : {0.5, 20.0}) {
    const ElectricParameters electric{{0.0, 0.0, field}, ratio, 1.0, 1.0};
    const PotentialSources sources = sources_of(electric, membrane, Vector::Zero(n_coefficients(kOrder)));
    const Vector3 interior(0.0, 0.0, field / (1.0 + depolarisation * (ratio - 1.0)));
    for (const double height : heights(0.2)) {
      if (height > 0.0) continue;
      const Matrix x = points.at_height(height);
      const PotentialSamples found = sample(x, position, sources);
      BOOST_TEST_CONTEXT("conductivity ratio " << ratio << " height " << height) {
        BOOST_TEST(max_difference(found.potential, -x * interior) < 1e-8 * field);
        BOOST_TEST(max_difference(found.field, interior.transpose().replicate(x.rows(), 1)) < 1e-8 * field);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(samples_on_the_membrane_are_the_traces) {
  constexpr int kOrder = 24;
  const Space space(kOrder);
  const Matrix position = asymmetric_shape(kOrder);
  const Membrane membrane = make_membrane(space, position, kLaplaceLayers);
  const ElectricParameters electric{{0.3, -0.4, 1.0}, 0.5, 1.0, 1.0};
  const Vector potential = smooth_coefficients(kOrder, 4, 1, 71);
  const SecondKindSolution density = solve_density(electric, membrane, potential);
  const ElectricTraces traces = electric_traces(electric, membrane, potential, density);
  const PotentialSources sources{electric.field, potential, conductivity_contrast(electric) * density.weighted};
  const GridAngles angles = scattered_angles(30);
  const MembranePoints points = membrane_points(position, angles);
  const PotentialSamples in = sample(points.position, position, sources, Side::interior);
  const PotentialSamples out = sample(points.position, position, sources, Side::exterior);
  const Vector phi_in = evaluate_harmonics(traces.potential_in, angles.theta, angles.phi);
  const Vector phi_out = evaluate_harmonics(traces.potential_out, angles.theta, angles.phi);
  BOOST_TEST(max_difference(in.potential, phi_in) < 2e-6);
  BOOST_TEST(max_difference(out.potential, phi_out) < 2e-6);
  // The values −∂φ/∂n satisfy σ_i E_i·n = σ_e E_e·n.
  const Vector normal_in = row_dot(in.field, points.normal);
  const Vector normal_out = row_dot(out.field, points.normal);
  BOOST_TEST(relative_difference(electric.conductivity_in * normal_in, electric.conductivity_out * normal_out) < 1e-3);
}

BOOST_AUTO_TEST_CASE(point_sources_on_shape_33_are_met_with_one_error_at_every_distance) {
  struct Bound {
    int order;
    double potential, field_in, field_out;
  };
  for (const Bound& bound : {Bound{12, 1e-3, 3e-2, 2e-3}, {16, 1e-4, 5e-3, 2e-4}, {24, 1.5e-6, 1.5e-4, 7e-6}}) {
    const Example1 example(bound.order);
    const MembranePoints points = membrane_points(example.position, scattered_angles(40));
    for (const Side side : {Side::interior, Side::exterior}) {
      const Example1::Errors on_membrane = example.errors(points, 0.0, side);
      for (const double distance : {0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.2, 0.5, 1.0, 3.0}) {
        if (side == Side::interior && distance > 0.2) continue;
        const double height = side == Side::interior ? -distance : distance;
        const Example1::Errors errors = example.errors(points, height, side);
        BOOST_TEST_MESSAGE("p " << bound.order << (side == Side::interior ? " inside" : " outside") << " distance "
                                << distance << " potential " << errors.potential << " field " << errors.field);
        BOOST_TEST_CONTEXT("order " << bound.order << " height " << height) {
          BOOST_TEST(errors.potential < bound.potential);
          BOOST_TEST(errors.field < (side == Side::interior ? bound.field_in : bound.field_out));
          BOOST_TEST(errors.potential < 1.2 * on_membrane.potential);
          BOOST_TEST(errors.field < 1.2 * on_membrane.field);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(absent_charge_and_membrane_potential_leave_the_applied_field) {
  Matrix points(2, 3);
  points << 0.1, 0.2, 0.3, 1.0, 2.0, 3.0;
  const Vector3 field(0.5, -1.0, 2.0);
  const PotentialSamples found = sample(points, sphere(6), {field, {}, {}});
  BOOST_TEST(max_difference(found.potential, -points * field) < 1e-15);
  BOOST_TEST(max_difference(found.field, field.transpose().replicate(2, 1)) < 1e-15);
  BOOST_TEST((found.side[0] == Side::interior));
  BOOST_TEST((found.side[1] == Side::exterior));
}

BOOST_AUTO_TEST_CASE(translating_sphere_makes_the_flow_of_stokes_in_a_background_flow) {
  // u = F/(6πμR) inside and F·[(I + r̂r̂)/r + R²(I − 3r̂r̂)/(3r³)]/(8πμ) outside.
  const double radius = 1.4;
  const double viscosity = 2.5;
  const Matrix position = sphere(8, radius);
  const Vector3 force(0.3, -0.8, 0.5);
  VelocitySources sources;
  sources.viscosity = viscosity;
  sources.background = [](const Vector3& p) { return Vector3(0.6 * p.z(), 0.0, 0.0); };
  sources.weighted_force = Matrix::Zero(n_coefficients(8), 3);
  sources.weighted_force.row(0) = force.transpose() / std::sqrt(4.0 * std::numbers::pi);
  const MembranePoints points = membrane_points(position, scattered_angles(20));
  std::vector<double> all = heights(1.0);
  all.push_back(0.0);
  for (const double height : all) {
    const Matrix x = points.at_height(height);
    const Matrix found = velocity(x, position, sources);
    double error = 0.0;
    for (Index i = 0; i < x.rows(); ++i) {
      const Vector3 p = x.row(i).transpose();
      const double r = p.norm();
      const Vector3 n = p / r;
      Vector3 exact = force / (6.0 * std::numbers::pi * viscosity * radius);
      if (height > 0.0) {
        exact =
            ((force + n.dot(force) * n) / r + radius * radius / (3.0 * r * r * r) * (force - 3.0 * n.dot(force) * n)) /
            (8.0 * std::numbers::pi * viscosity);
      }
      exact.x() += 0.6 * p.z();
      error = std::max(error, (found.row(i).transpose() - exact).norm() / std::max(1.0, r));
    }
    BOOST_TEST(error < 1e-10, "height " << height << " error " << error);
  }
}

BOOST_AUTO_TEST_CASE(translating_prolate_carries_its_fluid_along_up_to_the_membrane) {
  // The density (x·n) e moves the 2:1 prolate as a rigid body (translating_prolate_test.cpp); J x·n is constant.
  constexpr int kOrder = 24;
  const double eccentricity = std::sqrt(0.75);
  const double e2 = 0.75;
  const double logarithm = std::log((1.0 + eccentricity) / (1.0 - eccentricity));
  const double speed = (-2.0 * eccentricity + (1.0 + e2) * logarithm) / (4.0 * e2 * eccentricity);
  const Matrix position = move_poles(prolate(kOrder), general_rotation());
  const Space space(kOrder);
  const Surface surface = make_surface(space.fine, position);
  VelocitySources sources;
  sources.weighted_force =
      weighted(space, surface, row_dot(surface.position, surface.normal) * Vector3::UnitZ().transpose());
  const MembranePoints points = membrane_points(position, scattered_angles(20));
  for (const double height : heights(0.2)) {
    if (height > 1e-8) continue;
    const Matrix found = velocity(points.at_height(height), position, sources);
    const Matrix exact = speed * Vector3::UnitZ().transpose().replicate(found.rows(), 1);
    BOOST_TEST(max_difference(found, exact) < 1e-7 * speed, "height " << height);
  }
}

// The flow of a distant point force is the same in both fluids if the membrane supplies the difference of the
// tractions, f = (Λ − 1) t.
BOOST_AUTO_TEST_CASE(flow_common_to_two_fluids_is_found_inside_on_and_outside_the_membrane) {
  const Vector3 far(2.4, 1.1, -1.6), force(0.7, -0.4, 0.6);
  const auto exact_at = [&](const Vector3& x) -> Vector3 {
    const Vector3 r = x - far;
    const double d = r.norm();
    return stokes_single_layer_prefactor(1.0) * (force / d + r.dot(force) / (d * d * d) * r);
  };
  for (const auto& [order, bound] : {std::pair{16, 2e-3}, {24, 1e-5}}) {
    const Space space(order);
    const Matrix position = asymmetric_shape(order);
    const Surface surface = make_surface(space.fine, position);
    const PointForce flow = point_force(surface, far, force);
    const MembranePoints points = membrane_points(position, scattered_angles(20));
    for (const double ratio : {0.2, 1.0, 300.0}) {
      VelocitySources sources;
      sources.background = exact_at;
      sources.viscosity_ratio = ratio;
      sources.weighted_force = (ratio - 1.0) * weighted(space, surface, flow.traction);
      sources.membrane_velocity = space.fine.analyze(flow.velocity);
      for (const double height : {-0.1, -1e-3, -1e-8, 0.0, 1e-8, 0.03, 1.0}) {
        const Matrix x = points.at_height(height);
        Matrix exact(x.rows(), 3);
        for (Index i = 0; i < x.rows(); ++i) exact.row(i) = exact_at(x.row(i).transpose()).transpose();
        const double scale = std::abs(ratio - 1.0) * (height < 0.0 ? 1.0 / ratio : 1.0) + 1e-9;
        BOOST_TEST(relative_difference(velocity(x, position, sources), exact) < bound * scale,
                   "degree " << order << " ratio " << ratio << " height " << height);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_ratio_of_viscosities_that_divides_by_zero_is_refused) {
  VelocitySources sources;
  sources.viscosity_ratio = 0.0;
  BOOST_CHECK_THROW(velocity(Matrix::Ones(1, 3), sphere(8, 1.0), sources), InputError);
}

BOOST_AUTO_TEST_CASE(unresolved_points_are_refused_by_name) {
  const Matrix disc = ellipsoid(12, {1.0, 1.0, 0.01});
  PotentialSources sources;
  sources.transmembrane_potential = smooth_coefficients(12, 4, 1, 72);
  Matrix points(1, 3);
  points << 0.3, 0.1, 0.005;
  BOOST_CHECK_THROW(sample(points, disc, sources), ConvergenceError);
}

BOOST_AUTO_TEST_SUITE_END()
