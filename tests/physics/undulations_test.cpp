#include "bie/physics/effects/undulations.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

using namespace vehd;

namespace {

/// k_BT = 4.11e-21 J, κ_c = 1e-19 J and K_A = 0.24 N/m of a vesicle of radius 10 µm, in units of κ_c and the radius.
Undulations lipid_vesicle() { return {0.0411, 1.0, 2.4e8, 4.0 * std::numbers::pi, 0.0}; }

}  // namespace

BOOST_AUTO_TEST_SUITE(undulations)

BOOST_AUTO_TEST_CASE(area_is_that_of_the_law) {
  const AreaLaw law(lipid_vesicle());
  const double area = 4.0 * std::numbers::pi;
  for (const double tension : {0.0, 1.0, 1e3, 1e6}) {
    const double strain = 0.0411 / (8.0 * std::numbers::pi) * std::log(1.0 + 0.1 * tension * area) + tension / 2.4e8;
    BOOST_TEST(std::abs(law.area(tension) / area - 1.0 - strain) < 1e-14);
  }
  BOOST_TEST(law.least_tension() == -1.0 / (0.1 * area), boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(tension_is_the_inverse_of_area_with_each_part_of_the_law) {
  Undulations stretches = lipid_vesicle(), undulates = lipid_vesicle();
  stretches.thermal_energy = 0.0;
  undulates.stretching_modulus.reset();
  for (const Undulations& membrane : {lipid_vesicle(), stretches, undulates}) {
    const AreaLaw law(membrane);
    for (const double tension : {-0.7, -1e-3, 0.0, 0.1, 10.0, 1e4, 1e6}) {
      const double error = law.tension(law.area(tension)) - tension;
      // Change of tension caused by one rounding of the area.
      const double rounding = 1e-15 * law.area(tension) / law.slope(tension);
      BOOST_TEST(std::abs(error) <= 1e-12 * std::abs(tension) + 4.0 * rounding, tension << ": " << error);
    }
  }
}

BOOST_AUTO_TEST_CASE(slope_is_the_derivative_of_area) {
  const AreaLaw law(lipid_vesicle());
  for (const double tension : {-0.5, 0.0, 1.0, 1e3}) {
    const double h = 1e-4 * std::max(1.0, tension);
    const double difference = (law.area(tension + h) - law.area(tension - h)) / (2.0 * h);
    BOOST_TEST(std::abs(difference / law.slope(tension) - 1.0) < 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(area_of_a_compressed_membrane_has_a_tension_above_the_least) {
  const AreaLaw law(lipid_vesicle());
  const double tension = law.tension(0.97 * law.rest_area());
  BOOST_TEST(tension >= law.least_tension());
  BOOST_TEST(tension < 0.99 * law.least_tension());
}

BOOST_AUTO_TEST_CASE(area_at_rest_follows_from_the_reference_tension_or_is_given) {
  Undulations membrane = lipid_vesicle();
  membrane.rest_area = 0.0;
  membrane.reference_tension = 50.0;
  const double area = 13.0;
  BOOST_TEST(std::abs(AreaLaw(with_rest_area(membrane, area)).area(50.0) / area - 1.0) < 1e-14);
  membrane.rest_area = 12.5;
  BOOST_TEST(with_rest_area(membrane, area).rest_area == 12.5);
}

BOOST_AUTO_TEST_SUITE_END()
