#include <boost/test/unit_test.hpp>

#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/spontaneous_curvature.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(varying_membrane_elasticity)

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kElasticDegree = 32;

/// Material with κ_B between 0.4 and 1 and c between −1 and −0.2.
MembraneMaterial elastic_material(const SphereTransform& fine) {
  const auto of = [&](double mean, double amplitude, unsigned seed) -> Vector {
    Vector coefficients = smooth_coefficients(kElasticDegree, 3, 1, seed).col(0);
    coefficients[0] = 0.0;
    const Vector values = fine.synthesize(coefficients);
    return mean + amplitude / values.cwiseAbs().maxCoeff() * values.array();
  };
  MembraneMaterial material;
  material.bending_modulus = of(0.7, 0.3, 5);
  material.spontaneous_curvature = of(-0.6, 0.4, 6);
  return material;
}

/// Membrane with this material; κ_B and c at given (θ, φ) are the same for every shape.
struct ElasticMembrane {
  Space space{kElasticDegree};
  Matrix position;
  Membrane membrane;

  explicit ElasticMembrane(const Matrix& shape) : position(shape), membrane(make_membrane(space, shape, {})) {
    membrane.material = elastic_material(space.fine);
  }

  [[nodiscard]] double energy_at(const Matrix& displaced) const {
    Membrane there = make_membrane(space, displaced, {});
    there.material = membrane.material;
    return elastic_energy(there);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(the_force_is_minus_the_gradient_of_the_energy) {
  for (const ElasticMembrane& one :
       {ElasticMembrane(asymmetric_shape(kElasticDegree)), ElasticMembrane(shape_33(kElasticDegree))}) {
    const Matrix force = elastic_force(one.membrane);
    for (const int band : {2, 4}) {
      Matrix direction = smooth_coefficients(kElasticDegree, band, 3, 160 + static_cast<unsigned>(band));
      direction /= direction.norm();
      const double h = 1e-4;
      const double slope =
          (one.energy_at(one.position + h * direction) - one.energy_at(one.position - h * direction)) / (2.0 * h);
      const double work = row_dot(force, one.space.fine.synthesize(direction)).dot(one.membrane.surface.quadrature);
      BOOST_TEST_MESSAGE("band " << band << ": " << slope << " and " << -work);
      BOOST_TEST(std::abs(slope + work) < 1e-5 * std::abs(slope), "band " << band << ": " << slope << " and " << -work);
    }
  }
}

BOOST_AUTO_TEST_CASE(sliding_material_along_a_sphere_costs_energy) {
  // To first order in the displacement the shape is unchanged: the whole slope comes from the tangential part.
  const ElasticMembrane one(sphere(kElasticDegree));
  const Matrix force = elastic_force(one.membrane);
  const Vector3 axis(0.3, -0.5, 0.8);
  const Matrix& r = one.membrane.surface.normal;
  Matrix sliding(r.rows(), 3);
  for (Index i = 0; i < r.rows(); ++i) {
    const Vector3 n = r.row(i);
    sliding.row(i) = (n.x() * axis.cross(n) + n.cross(Vector3(n.y(), 0.0, n.x()))).transpose();
  }
  const Matrix direction = one.space.fine.analyze(sliding);
  const double h = 1e-4;
  const double slope =
      (one.energy_at(one.position + h * direction) - one.energy_at(one.position - h * direction)) / (2.0 * h);
  const double work = row_dot(force, sliding).dot(one.membrane.surface.quadrature);
  BOOST_TEST(std::abs(slope) > 0.01);
  BOOST_TEST(std::abs(slope + work) < 1e-5 * std::abs(slope), slope << " and " << -work);
}

BOOST_AUTO_TEST_CASE(neither_force_nor_torque_is_left) {
  const ElasticMembrane one(asymmetric_shape(kElasticDegree));
  const Surface& s = one.membrane.surface;
  const Matrix force = elastic_force(one.membrane);
  const double size = force.rowwise().norm().dot(s.quadrature);
  Vector3 torque = Vector3::Zero();
  for (Index i = 0; i < force.rows(); ++i) {
    torque += s.quadrature[i] * Vector3(s.position.row(i)).cross(Vector3(force.row(i)));
  }
  const Vector3 total = force.transpose() * s.quadrature;
  BOOST_TEST_MESSAGE(total.norm() / size << " " << torque.norm() / size);
  BOOST_TEST(total.norm() < 1e-6 * size);
  BOOST_TEST(torque.norm() < 1e-6 * size);
}

BOOST_AUTO_TEST_CASE(the_same_everywhere_is_bending_with_spontaneous_curvature) {
  ElasticMembrane one(asymmetric_shape(kElasticDegree));
  const Index n = one.membrane.surface.n_points();
  one.membrane.material.bending_modulus = Vector::Constant(n, 0.7);
  one.membrane.material.spontaneous_curvature = Vector::Zero(n);
  Membrane uniform = make_membrane(one.space, one.position, {});
  const Matrix bending = bending_force({0.7}, uniform);
  BOOST_TEST(relative_difference(elastic_force(one.membrane), bending) < 1e-9);
  BOOST_TEST(std::abs(elastic_energy(one.membrane) / (0.7 * bending_energy_scaled(uniform.surface)) - 1.0) < 1e-12);
  one.membrane.material.spontaneous_curvature = Vector::Constant(n, -0.6);
  Forcing forcing{bending, Matrix()};
  SpontaneousCurvatureEffect({0.7, -0.6}).add({uniform, one.position, 0.0}, forcing);
  BOOST_TEST(relative_difference(elastic_force(one.membrane), forcing.force) < 1e-5);
  const Vector increment = smooth_coefficients(kElasticDegree, 4, 1, 9).col(0);
  BOOST_TEST(relative_difference(linearised_bending_force({0.7}, one.membrane, increment),
                                 linearised_bending_force({0.7}, uniform, increment)) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
