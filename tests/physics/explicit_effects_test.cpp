#include <boost/test/unit_test.hpp>

#include "bie/physics/effects/background_flow.hpp"
#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/poiseuille_flow.hpp"
#include "bie/physics/effects/spontaneous_curvature.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kDegree = 32;

struct EffectFixture : AsymmetricMembrane {
  EffectFixture() : AsymmetricMembrane(kDegree) {}

  [[nodiscard]] Forcing forcing_of(const ExplicitEffect& effect, double time = 0.0) const {
    Forcing forcing{Matrix::Zero(membrane.surface.n_points(), 3), Matrix::Zero(position.rows(), 3)};
    effect.add({membrane, position, time}, forcing);
    return forcing;
  }
};

/// Energy κ_B ∫ (H − c)² dA.
double energy(const Space& space, const Matrix& x, double modulus, double c) {
  const Surface s = make_surface(space.fine, x);
  return modulus * (s.mean_curvature.array() - c).square().matrix().dot(s.quadrature);
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(explicit_effects, EffectFixture)

BOOST_AUTO_TEST_CASE(spontaneous_curvature_with_bending_is_minus_the_gradient_of_the_energy) {
  const double modulus = 0.7;
  const double c = -0.6;
  const Matrix force = bending_force({modulus}, membrane) + forcing_of(SpontaneousCurvatureEffect({modulus, c})).force;
  for (const int band : {2, 4, 6}) {
    Matrix direction = smooth_coefficients(kDegree, band, 3, 160 + band);
    direction /= direction.norm();
    const double h = 1e-4;
    const double slope =
        (energy(space, position + h * direction, modulus, c) - energy(space, position - h * direction, modulus, c)) /
        (2.0 * h);
    const double work = row_dot(force, space.fine.synthesize(direction)).dot(membrane.surface.quadrature);
    BOOST_TEST(std::abs(slope + work) < 1e-5 * std::abs(slope), "band " << band << ": " << slope << " and " << -work);
  }
}

BOOST_AUTO_TEST_CASE(gravity_adds_up_to_the_weight_at_the_centre_of_volume) {
  const Vector3 g(0.3, -0.4, -1.2);
  const Matrix force = forcing_of(GravityEffect({2.5, g})).force;
  const Surface& s = membrane.surface;
  const Vector3 total = force.transpose() * s.quadrature;
  BOOST_TEST((total - 2.5 * enclosed_volume(s) * g).norm() < 1e-10);
  // ∫ x_j dV = ½ ∫ x_j² n_j dA.
  Vector3 centre;
  for (int j = 0; j < 3; ++j) {
    centre[j] = 0.5 * s.position.col(j).array().square().matrix().cwiseProduct(s.normal.col(j)).dot(s.quadrature);
  }
  centre /= enclosed_volume(s);
  Vector3 torque = Vector3::Zero();
  for (Index i = 0; i < force.rows(); ++i) {
    const Vector3 arm = s.position.row(i).transpose() - centre;
    torque += s.quadrature[i] * arm.cross(Vector3(force.row(i)));
  }
  BOOST_TEST(torque.norm() < 1e-10);
}

BOOST_AUTO_TEST_CASE(poiseuille_flow_is_the_written_profile) {
  const PoiseuilleFlowEffect effect({1.5, 2.0, Waveform::alternating(1.0, 1.0, 0.0)});
  const Matrix velocity = space.fine.synthesize(forcing_of(effect, 0.125).velocity);
  const Matrix& x = membrane.surface.position;
  const Vector expected = 1.5 * std::sqrt(0.5) * (1.0 - (x.col(1).array().square() + x.col(2).array().square()) / 4.0);
  BOOST_TEST((velocity.col(0) - expected).cwiseAbs().maxCoeff() < 1e-12);
  BOOST_TEST(velocity.rightCols(2).isZero(0.0));
}

BOOST_AUTO_TEST_CASE(symmetries_are_those_of_the_forcing) {
  const Reflection mirror_x{-1, 1, 1};
  const Reflection mirror_z{1, 1, -1};
  const Reflection turn_y{-1, 1, -1};
  const LinearFlowEffect shear(shear_flow(1.0));
  BOOST_TEST(!shear.is_invariant_under(mirror_x));
  BOOST_TEST(shear.is_invariant_under(turn_y));
  BOOST_TEST(!shear.is_axisymmetric());
  BOOST_TEST(LinearFlowEffect(axisymmetric_extension(1.0)).is_axisymmetric());
  const PoiseuilleFlowEffect poiseuille({});
  BOOST_TEST(poiseuille.is_invariant_under(mirror_z));
  BOOST_TEST(!poiseuille.is_invariant_under(mirror_x));
  const GravityEffect gravity({1.0, {0.0, 0.0, -1.0}});
  BOOST_TEST(gravity.is_invariant_under(mirror_x));
  BOOST_TEST(!gravity.is_invariant_under(mirror_z));
  BOOST_TEST(gravity.is_axisymmetric());
  BOOST_TEST(PoiseuilleFlowEffect({1.0, 1.0, {}, Vector3::UnitZ()}).is_axisymmetric());
}

BOOST_AUTO_TEST_CASE(rotated_effect_does_the_same_to_the_rotated_body) {
  const Matrix3 r = general_rotation();
  const Matrix rotated_position = position * r.transpose();
  const Membrane rotated_membrane = make_membrane(space, rotated_position, {});
  const Waveform waveform = Waveform::alternating(1.0, 1.0, 0.0);
  BackgroundFlow flow = shear_flow(1.3);
  flow.waveform = waveform;
  const std::vector<std::shared_ptr<const ExplicitEffect>> effects{
      std::make_shared<LinearFlowEffect>(flow),
      std::make_shared<PoiseuilleFlowEffect>(PoiseuilleParameters{1.5, 2.0, waveform}),
      std::make_shared<GravityEffect>(GravityParameters{2.5, {0.4, -0.2, 0.7}}),
      std::make_shared<SpontaneousCurvatureEffect>(SpontaneousCurvatureParameters{0.1, -0.6})};
  for (const auto& effect : effects) {
    const Forcing expected = forcing_of(*effect, 0.1);
    Forcing forcing{Matrix::Zero(expected.force.rows(), 3), Matrix::Zero(position.rows(), 3)};
    effect->rotated(r)->add({rotated_membrane, rotated_position, 0.1}, forcing);
    const double scale = expected.force.norm() + expected.velocity.norm();
    BOOST_TEST(scale > 0.1);
    BOOST_TEST((forcing.force - expected.force * r.transpose()).norm() < 1e-11 * scale);
    BOOST_TEST((forcing.velocity - expected.velocity * r.transpose()).norm() < 1e-11 * scale);
  }
}

BOOST_AUTO_TEST_SUITE_END()
