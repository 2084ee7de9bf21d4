#include "bie/scene/shapes/initial_shape.hpp"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/geometry/surface.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/runs.hpp"

BOOST_AUTO_TEST_SUITE(initial_shape)

namespace {

using vehd::Matrix;
using vehd::Vector;
using vehd::Vector3;

const Vector theta{{0.0, 0.4, 1.3, 2.2, std::numbers::pi}};
const Vector phi{{0.0, 0.7, 2.0, 5.5, 0.0}};

Vector3 direction(vehd::Index i) {
  return {std::sin(theta(i)) * std::cos(phi(i)), std::sin(theta(i)) * std::sin(phi(i)), std::cos(theta(i))};
}

vehd::Scene scene_of(const std::string& shape, int order = 16) {
  return parsed("[shape]\n" + shape + "\n[numerics]\ndt=1\nend_time=1\norder=" + std::to_string(order) + "\n");
}

Matrix position_of(const std::string& shape, int order = 16) { return vehd::initial_position(scene_of(shape, order)); }

double reduced_volume_of(const vehd::ShapeSize& size) {
  return 6.0 * std::sqrt(std::numbers::pi) * size.volume / std::pow(size.area, 1.5);
}

vehd::Symmetry symmetry_of(const std::string& shape) {
  return vehd::find_symmetry(vehd::model_of(scene_of(shape)), vehd::testing::at_rest(position_of(shape)));
}

double bending_energy(const Matrix& position, int grid_order) {
  const vehd::SphereTransform transform(vehd::order_of(position.rows()), vehd::make_grid(grid_order));
  const vehd::Surface surface = vehd::make_surface(transform, position);
  return surface.quadrature.dot(surface.mean_curvature.cwiseAbs2());
}

/// Largest distance between the shape and radius(i) times the direction at the test points.
template <typename Radius>
double error_of(const std::string& text, const Radius& radius) {
  const Matrix points = vehd::evaluate_harmonics(vehd::initial_position(parsed(text)), theta, phi);
  double error = 0.0;
  for (vehd::Index i = 0; i < theta.size(); ++i) {
    error = std::max(error, (points.row(i).transpose() - radius(i) * direction(i)).norm());
  }
  return error;
}

}  // namespace

BOOST_AUTO_TEST_CASE(ellipsoid_has_the_given_axes) {
  const Matrix points = vehd::evaluate_harmonics(
      vehd::initial_position(parsed("[shape]\nkind='ellipsoid'\naxes=[1,2,3]\n[numerics]\ndt=1\nend_time=1\n")), theta,
      phi);
  for (vehd::Index i = 0; i < theta.size(); ++i) {
    const Vector3 expected = Vector3(1, 2, 3).cwiseProduct(direction(i));
    BOOST_TEST((points.row(i).transpose() - expected).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(radial_mode_is_the_harmonic_of_equation_17) {
  // Y_2^1 = sqrt(5/4π · 1!/3!) 3 sinθ cosθ e^{iφ}
  const double factor = std::sqrt(5.0 / (4.0 * std::numbers::pi) / 6.0) * 3.0;
  const std::string numerics = "[numerics]\norder=12\ndt=1\nend_time=1\n";
  const auto radius = [&](auto trigonometric, vehd::Index i) {
    return 1.5 + 0.1 * factor * std::sin(theta(i)) * std::cos(theta(i)) * trigonometric(phi(i));
  };
  BOOST_TEST(error_of("[shape]\nkind='radial'\nbase=1.5\nmodes=[{n=2,m=1,a=0.1}]\n" + numerics,
                      [&](vehd::Index i) { return radius([](double x) { return std::cos(x); }, i); }) < 1e-13);
  BOOST_TEST(error_of("[shape]\nkind='radial'\nbase=1.5\nmodes=[{n=2,m=-1,a=0.1}]\n" + numerics,
                      [&](vehd::Index i) { return radius([](double x) { return std::sin(x); }, i); }) < 1e-13);
}

BOOST_AUTO_TEST_CASE(shape_33_converges_with_the_order) {
  // Y_3^2 = sqrt(7/4π · 1!/5!) 15 sin²θ cosθ e^{2iφ}
  const double factor = std::sqrt(7.0 / (4.0 * std::numbers::pi) / 120.0) * 15.0;
  const auto error = [&](int order) {
    return error_of(
        "[shape]\nkind='radial'\nbase=1\namplitude=0.2\nexponent=-3\nmodes=[{n=3,m=2,a=1}]\n[numerics]\n"
        "dt=1\nend_time=1\norder=" +
            std::to_string(order) + "\n",
        [&](vehd::Index i) {
          const double s = factor * std::pow(std::sin(theta(i)), 2) * std::cos(theta(i)) * std::cos(2.0 * phi(i));
          return 1.0 + 0.2 * std::exp(-3.0 * s);
        });
  };
  BOOST_TEST(error(16) < error(8) / 10.0);
  BOOST_TEST(error(48) < 1e-9);
}

BOOST_AUTO_TEST_CASE(families_have_the_reduced_volume_and_the_area_of_the_unit_sphere) {
  for (const auto& [kind, volume] : {std::pair{"prolate", 0.4},
                                     {"prolate", 0.95},
                                     {"oblate", 0.3},
                                     {"oblate", 0.95},
                                     {"prolate", 0.999999},
                                     {"oblate", 0.999999},
                                     {"biconcave", 0.5},
                                     {"biconcave", 0.65},
                                     {"biconcave", 0.75}}) {
    const vehd::ShapeSize size =
        vehd::size_of(position_of(fmt::format("kind='{}'\nreduced_volume={}", kind, volume), 4));
    BOOST_TEST(size.area == 4.0 * std::numbers::pi, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(reduced_volume_of(size) == volume, boost::test_tools::tolerance(1e-10));
  }
}

// Δ = A/a_V² − 4π; an ellipsoid stays an ellipsoid, a radial shape keeps its modes.
BOOST_AUTO_TEST_CASE(shapes_are_moved_to_a_reduced_volume_or_excess_area) {
  for (const double volume : {0.8, 0.95, 0.999}) {
    for (const char* shape :
         {"kind='ellipsoid'\naxes=[1,1.2,1.5]", "kind='radial'\nmodes=[{n=2,m=0,a=0.3},{n=3,m=2,a=0.1}]"}) {
      const double excess = 4.0 * std::numbers::pi * (std::pow(volume, -2.0 / 3.0) - 1.0);
      const Matrix position = position_of(fmt::format("{}\nreduced_volume={}", shape, volume));
      BOOST_TEST(reduced_volume_of(vehd::size_of(position)) == volume, boost::test_tools::tolerance(1e-11));
      const Matrix same = position_of(fmt::format("{}\nexcess_area={}", shape, excess));
      BOOST_TEST((position - same).norm() < 1e-9);
    }
  }
  const Matrix ellipsoid = position_of("kind='ellipsoid'\naxes=[1,1.2,1.5]\nreduced_volume=0.9");
  BOOST_TEST(ellipsoid.bottomRows(ellipsoid.rows() - 4).norm() < 1e-14);
  BOOST_TEST((position_of("kind='ellipsoid'\naxes=[1,1,2]\nexcess_area=0") -
              position_of("kind='ellipsoid'\naxes=[1,1,1]\narea=" +
                          fmt::format("{}", vehd::size_of(position_of("kind='ellipsoid'\naxes=[1,1,2]")).area)))
                 .norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(prolate_of_reduced_volume_0_9_has_the_known_aspect) {
  const Matrix position = position_of("kind='prolate'\nreduced_volume=0.9");
  const double aspect = position(vehd::coefficient_index(1, 0), 2) / position(vehd::coefficient_index(1, 1), 0);
  BOOST_TEST(aspect == 1.9621762549176331, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(reduced_volume_one_is_the_sphere_itself) {
  const Matrix sphere = position_of("kind='ellipsoid'\naxes=[1,1,1]");
  BOOST_TEST((position_of("kind='prolate'\nreduced_volume=1") == sphere));
  BOOST_TEST((position_of("kind='oblate'\nreduced_volume=1") == sphere));
}

BOOST_AUTO_TEST_CASE(biconcave_is_thinner_in_the_middle_and_resolved) {
  for (const double volume : {0.5, 0.65, 0.75}) {
    const Matrix position = position_of(fmt::format("kind='biconcave'\nreduced_volume={}", volume));
    const Matrix points = vehd::evaluate_harmonics(position, Vector{{0.0, 0.25}}, Vector{{0.0, 0.0}});
    BOOST_TEST(points(0, 2) > 0.0);
    BOOST_TEST(points(0, 2) < points(1, 2));
    BOOST_TEST(bending_energy(position, 32) == bending_energy(position, 128), boost::test_tools::tolerance(1e-5));
  }
  BOOST_TEST(bending_energy(position_of("kind='biconcave'"), 128) == 4.0 * std::numbers::pi * 1.881,
             boost::test_tools::tolerance(5e-4));
}

BOOST_AUTO_TEST_CASE(stomatocyte_is_a_bowl_with_a_narrow_mouth) {
  for (const double volume : {0.2, 0.45, 0.6}) {
    const Matrix position = position_of(fmt::format("kind='stomatocyte'\nreduced_volume={}", volume), 48);
    const vehd::ShapeSize size = vehd::size_of(position);
    BOOST_TEST(size.area == 4.0 * std::numbers::pi, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(reduced_volume_of(size) == volume, boost::test_tools::tolerance(1e-9));
    constexpr double half = 0.5 * std::numbers::pi;
    const Matrix points =
        vehd::evaluate_harmonics(position, Vector{{0.0, 0.8, half, std::numbers::pi}}, Vector::Zero(4));
    BOOST_TEST(points(0, 2) > points(3, 2));
    BOOST_TEST(points(3, 2) > 0.0);
    BOOST_TEST(points(2, 2) < 0.0);
    BOOST_TEST(points(2, 0) < points(1, 0));
    BOOST_TEST(symmetry_of(fmt::format("kind='stomatocyte'\nreduced_volume={}", volume).c_str()).axisymmetric);
  }
}

BOOST_AUTO_TEST_CASE(families_are_exactly_symmetric) {
  for (const char* shape :
       {"kind='prolate'\nreduced_volume=0.8", "kind='oblate'\nreduced_volume=0.8", "kind='biconcave'"}) {
    const vehd::Symmetry symmetry = symmetry_of(shape);
    BOOST_TEST(symmetry.axisymmetric);
    BOOST_TEST(symmetry.reflections.size() == 8U);
    BOOST_TEST((position_of(shape).array() != 0.0).count() <= 4);
  }
}

BOOST_AUTO_TEST_CASE(radial_shape_has_no_rounding_in_coefficients_that_are_zero) {
  const Matrix position = position_of("kind='radial'\nmodes=[{n=2,m=0,a=0.3}]");
  for (int n = 0; n <= 16; ++n) {
    for (int m = -n; m <= n; ++m) {
      BOOST_TEST((m == 0 || position(vehd::coefficient_index(n, m), 2) == 0.0));
      BOOST_TEST((m == 1 || position(vehd::coefficient_index(n, m), 0) == 0.0));
    }
  }
}

BOOST_AUTO_TEST_CASE(quarter_turns_keep_coefficients_exactly_symmetric) {
  const std::string prolate = "kind='prolate'\nreduced_volume=0.8\n";
  const Matrix upright = position_of(prolate);
  const double a = upright(vehd::coefficient_index(1, 1), 0), c = upright(vehd::coefficient_index(1, 0), 2);
  const Matrix lying = position_of(prolate + "rotation=[0,1,0,90]");
  Matrix expected = Matrix::Zero(upright.rows(), 3);
  expected(vehd::coefficient_index(1, 1), 0) = c;
  expected(vehd::coefficient_index(1, -1), 1) = a;
  expected(vehd::coefficient_index(1, 0), 2) = a;
  BOOST_TEST((lying - expected).cwiseAbs().maxCoeff() < 1e-13);
  BOOST_TEST((lying.array() != 0.0).count() == 3);
  const vehd::Symmetry symmetry = symmetry_of("kind='biconcave'\nrotation=[0,2,0,-90]");
  BOOST_TEST(!symmetry.axisymmetric);
  BOOST_TEST(symmetry.reflections.size() == 8U);
  BOOST_TEST(symmetry_of("kind='biconcave'\nrotation=[0,0,1,33]").axisymmetric);
  BOOST_TEST(symmetry_of("kind='biconcave'\nrotation=[1,0,0,180]").axisymmetric);
}

BOOST_AUTO_TEST_CASE(rotation_is_right_handed_and_keeps_size) {
  const std::string radial = "kind='radial'\nmodes=[{n=3,m=2,a=0.2},{n=2,m=-1,a=0.1}]\n";
  const Matrix start = position_of(radial);
  const Matrix rotated = position_of(radial + "rotation=[1,2,-0.5,40]");
  const vehd::Matrix3 rotation =
      Eigen::AngleAxisd(40.0 * std::numbers::pi / 180.0, Vector3(1, 2, -0.5).normalized()).toRotationMatrix();
  const Matrix before = vehd::evaluate_harmonics(start, theta, phi);
  Vector theta_after = theta, phi_after = phi;
  for (vehd::Index i = 0; i < theta.size(); ++i) {
    const Vector3 d = rotation * direction(i);
    theta_after(i) = std::atan2(std::hypot(d.x(), d.y()), d.z());
    phi_after(i) = std::atan2(d.y(), d.x());
  }
  const Matrix after = vehd::evaluate_harmonics(rotated, theta_after, phi_after);
  for (vehd::Index i = 0; i < theta.size(); ++i) {
    const Vector3 expected = rotation * before.row(i).transpose();
    BOOST_TEST((after.row(i).transpose() - expected).norm() < 1e-12);
  }
  BOOST_TEST(vehd::size_of(rotated).area == vehd::size_of(start).area, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(area_scale_and_centre_are_as_wanted) {
  const std::string ellipsoid = "kind='ellipsoid'\naxes=[1,1.5,2]\n";
  const Matrix start = position_of(ellipsoid);
  BOOST_TEST((position_of(ellipsoid + "scale=2") - 2.0 * start).cwiseAbs().maxCoeff() < 1e-14);
  for (const std::string& shape :
       {ellipsoid, std::string("kind='biconcave'\n"), std::string("kind='prolate'\nreduced_volume=0.6\n"),
        std::string("kind='radial'\nmodes=[{n=3,m=2,a=0.2}]\n")}) {
    const vehd::ShapeSize size = vehd::size_of(position_of(shape + "area=10\nrotation=[1,0,0,20]\ncentre=[1,2,3]"));
    BOOST_TEST(size.area == 10.0, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(reduced_volume_of(size) == reduced_volume_of(vehd::size_of(position_of(shape))),
               boost::test_tools::tolerance(1e-10));
  }
  const Matrix moved = position_of(ellipsoid + "rotation=[0,0,1,90]\ncentre=[1,-2,3]");
  const Matrix rotated = position_of(ellipsoid + "rotation=[0,0,1,90]");
  const Matrix shift = vehd::evaluate_harmonics(moved, theta, phi) - vehd::evaluate_harmonics(rotated, theta, phi);
  for (vehd::Index i = 0; i < theta.size(); ++i) {
    BOOST_TEST((shift.row(i).transpose() - Vector3(1, -2, 3)).norm() < 1e-13);
  }
}

BOOST_AUTO_TEST_SUITE_END()
