#include "bie/comparison/coupled_check_fields.hpp"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>

#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(coupled_check_fields)

namespace {

using vehd::CheckFields;

vehd::FrozenState frozen_state(const std::string& scene) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", scene);
  return vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
}

std::vector<CheckFields> fields_at(const vehd::FrozenState& frozen, int order) {
  std::vector<vehd::Matrix> forces;
  for (std::size_t a = 0; a < 2; ++a) forces.push_back(vehd::total_force(frozen, frozen.fields.vesicles[a], a));
  return vehd::coupled_check_fields(frozen, vehd::check_contents(frozen), forces, {order, order});
}

/// Two equal ellipsoids, images of one another, at `centre` and at what it is with the opposite sign.
std::string pair_of(const std::string& axes, const vehd::Vector3& centre, const std::string& further) {
  const auto at = [](const vehd::Vector3& c) { return fmt::format("shape.centre = [{}, {}, {}]\n", c[0], c[1], c[2]); };
  return "[shape]\nkind = 'ellipsoid'\naxes = " + axes + "\n[membrane]\nbending_modulus = 0.1\nconductance = 1.0\n" +
         "[electric]\nfield = [0.0, 0.0, 1.0]\nconductivity_in = 2.0\nconductivity_out = 1.0\n" + further +
         "[numerics]\norder = 6\ndt = 0.1\nend_time = 0.0\n" + "[[vesicle]]\nname = 'first'\n" + at(centre) +
         "[[vesicle]]\nname = 'second'\n" + at(-centre);
}

}  // namespace

// An image has no operators of its own: its fields follow from those of its original.
BOOST_AUTO_TEST_CASE(vesicles_that_are_images_have_the_fields_of_vesicles_that_are_computed) {
  const std::string prolate = "[1.0, 1.0, 1.4]", sphere = "[1.0, 1.0, 1.0]",
                    contrast = "[fluid]\nviscosity_ratio = 3.0\n", shear = "[flow]\nkind = 'shear'\nrate = 1.0\n";
  const vehd::Vector3 above(0.0, 0.0, 1.75), beside(1.5, 0.0, 0.0);
  for (const std::string& scene :
       {pair_of(prolate, above, ""), pair_of(prolate, above, contrast), pair_of(prolate, beside, contrast + shear),
        pair_of(sphere, above, ""), pair_of(sphere, beside, shear)}) {
    const vehd::FrozenState frozen = frozen_state(scene);
    BOOST_TEST_REQUIRE(frozen.symmetry.exchange.any(), scene);
    vehd::FrozenState plain = frozen;
    plain.symmetry = {};
    for (const int order : {6, 8}) {
      const std::vector<CheckFields> images = fields_at(frozen, order), expected = fields_at(plain, order);
      for (std::size_t a = 0; a < 2; ++a) {
        const auto compare = [&](const char* name, const auto& field, const auto& right) {
          BOOST_TEST_REQUIRE(field.rows() == right.rows(), scene << name);
          BOOST_TEST((field - right).norm() <= 1e-7 * (1.0 + right.norm()), scene << name << " of " << a);
        };
        const auto of = [&](const char* name, auto CheckFields::*field) {
          compare(name, images[a].*field, expected[a].*field);
        };
        of("charge", &CheckFields::charge);
        of("force_electric", &CheckFields::force_electric);
        of("potential_rate", &CheckFields::potential_rate);
        of("force_bending", &CheckFields::force_bending);
        of("force_tension", &CheckFields::force_tension);
        of("tension", &CheckFields::tension);
        of("velocity_of_shape", &CheckFields::velocity_of_shape);
        of("velocity_truncation", &CheckFields::velocity_truncation);
        of("steady_potential", &CheckFields::steady_potential);
        of("steady_charge", &CheckFields::steady_charge);
        of("velocity", &CheckFields::velocity);
        of("velocity_own_force", &CheckFields::velocity_own_force);
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
