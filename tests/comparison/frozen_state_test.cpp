#include "bie/comparison/frozen_state.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/comparison/check_fields.hpp"
#include "bie/files/run_file.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(frozen_state)

BOOST_AUTO_TEST_CASE(fields_that_the_elements_do_not_know_are_refused) {
  const TemporaryDirectory directory;
  const std::string start =
      "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1.2]\n[numerics]\ndegree = 4\ndt = 0.1\nend_time = 1\n"
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n";
  const auto message = [&](const std::string& more) {
    write_text(directory / "scene.toml", start + more);
    try {
      vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
    } catch (const vehd::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(message("") == "");
  const std::string waveform = "[electric.waveform]\nkind = \"ac\"\nfrequency = 1\n";
  BOOST_TEST(message(waveform) == "");
  BOOST_TEST(message(waveform + "average = true\n").find("averaged ac field") != std::string::npos);
  BOOST_TEST(message("displacement_current = true\n") == "");
  const std::string poration = "[poration]\nthreshold_Vm = 1\nmodel = ";
  BOOST_TEST(message(poration + "\"porosity\"\nporated_conductance = 1\nporation_time = 1\nresealing_time = 2\n") ==
             "");
  BOOST_TEST(message(poration + "\"criterion\"\n") == "");
  const auto by_place = [](const std::string& property) {
    return "[membrane]\nbending_modulus = 0.1\nconductance = 1\n[membrane." + property +
           "_by_place]\nkind = \"harmonics\"\nmodes = [{n = 1, m = 0, a = 0.1}]\n";
  };
  BOOST_TEST(message(by_place("capacitance")) == "");
  BOOST_TEST(message(by_place("conductance")) == "");
  BOOST_TEST(message("displacement_current = true\n" + by_place("conductance")) == "");
  BOOST_TEST(message(by_place("bending")).find("bends differently") != std::string::npos);
  BOOST_TEST(message("displacement_current = true\n" + by_place("capacitance")).find("displacement currents") !=
             std::string::npos);
}

namespace {

/// A run of degree 12 that was solved in degree 8: its coefficients above are zero.
void write_padded_run(const std::string& path, const std::string& scene, const vehd::FrozenState& solved) {
  const vehd::SphereTransform transform(12, vehd::make_grid(12));
  vehd::Hdf5Writer file(path, vehd::Hdf5Writer::Mode::create);
  const vehd::SiUnits units = vehd::si_units_of(std::nullopt);
  vehd::write_run_header(file, transform, {scene, 1, units});
  vehd::write_snapshot(file, vehd::snapshot_name(0), transform, solved.state, solved.fields, units);
  file.close();
}

}  // namespace

// With a tolerance the file has the highest degree, and a state is solved in a lower one. Solved anew in that of the
// file every number differed by all that the lower one leaves out.
BOOST_AUTO_TEST_CASE(snapshot_has_the_degree_that_it_was_solved_in) {
  const TemporaryDirectory directory;
  const auto scene = [](const std::string& numerics) {
    return "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.2, 1.5]\n[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
           "[flow]\nkind = 'shear'\nrate = 1.0\n"
           "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\ninitial_Vm = 'steady'\n"
           "[numerics]\nend_time = 0.0\n" +
           numerics;
  };
  write_text(directory / "scene.toml", scene("degree = 8\ndt = 0.1\n"));
  const vehd::FrozenState solved = vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
  write_padded_run(directory / "run.h5", scene("degree = 12\ntolerance = 1e-3\n"), solved);

  const vehd::FrozenState read = vehd::read_frozen_state({directory / "run.h5", {}}, std::nullopt);
  const vehd::VesicleFields& stored = read.fields.vesicles.front();
  BOOST_TEST(vehd::order_of(read.state.vesicles.front().position.rows()) == 8);
  BOOST_TEST(vehd::order_of(stored.force_bending.rows()) == 8);
  const vehd::Matrix force = vehd::total_force(read, stored);
  const auto differences = [&](int order) {
    const vehd::CheckFields fields =
        vehd::check_fields(read, vehd::check_contents(read), force, order, vehd::Matrix(0, 3));
    const auto relative = [&](const vehd::Matrix& found, const vehd::Matrix& expected) {
      return (found - vehd::resize_order(expected, order)).norm() / expected.norm();
    };
    return std::vector<double>{
        relative(fields.charge, stored.charge), relative(fields.force_electric, stored.force_electric),
        relative(fields.force_bending, stored.force_bending), relative(fields.tension, stored.tension)};
  };
  for (const double difference : differences(8)) BOOST_TEST(difference < 1e-5);
  for (const double difference : differences(12)) BOOST_TEST(difference > 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()
