#include <boost/test/unit_test.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

/// Steps with a tolerance are few where the solution changes slowly. Bounds are generous: counts depend on rounding.
BOOST_AUTO_TEST_SUITE(number_of_steps, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

namespace {

std::size_t steps_of(const std::string& scene) {
  return vehd::testing::history_of(vehd::parse_scene(scene, "scene.toml", "/")).n_rows() - 1;
}

}  // namespace

// Regression: the field between spheres that drift slowly took 1000 steps.
BOOST_AUTO_TEST_CASE(spheres_that_drift_towards_each_other_take_long_steps) {
  BOOST_TEST(steps_of("[units]\nlength = '10 um'\ntime = '1 s'\npotential = '1 V'\n"
                      "[shape]\nkind = 'ellipsoid'\naxes = ['10 um', '10 um', '10 um']\n"
                      "[membrane]\nbending_modulus = '2e-19 J'\ncapacitance = '0.01 F/m^2'\n"
                      "[fluid]\nviscosity = '1 mPa s'\n"
                      "[electric]\nfield = [0, 0, '100 V/cm']\nconductivity_in = '1 mS/m'\n"
                      "conductivity_out = '2 mS/m'\npermittivity = '80 eps0'\ninitial_Vm = 'steady'\n"
                      "[numerics]\ntolerance = 1e-3\nend_time = '3.3 s'\n"
                      "[[vesicle]]\nname = 'lower'\nshape.centre = [0, 0, '-20 um']\n"
                      "[[vesicle]]\nname = 'upper'\nshape.centre = [0, 0, '20 um']\n") <= 100U);
}

// docs/hard_cases.md: 5, 8, 15 and 32 steps.
BOOST_AUTO_TEST_CASE(steps_of_a_stiff_membrane_shorten_more_slowly_than_its_bending_time) {
  const std::vector<std::pair<std::string, std::size_t>> most{{"1.0", 8}, {"10.0", 12}, {"100.0", 23}, {"1000.0", 48}};
  for (const auto& [modulus, steps] : most) {
    const std::size_t taken = steps_of(
        "[shape]\nkind = 'prolate'\nreduced_volume = 0.9\nrotation = [0, 1, 0, 30]\n"
        "[membrane]\nbending_modulus = " +
        modulus +
        "\n[flow]\nkind = 'shear'\nrate = 1.0\n"
        "[numerics]\ntolerance = 1e-3\nend_time = 0.2\n");
    BOOST_TEST(taken <= steps, "bending modulus " << modulus << ": " << taken << " steps");
  }
}

BOOST_AUTO_TEST_SUITE_END()
