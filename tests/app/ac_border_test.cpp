#include <boost/test/unit_test.hpp>
#include <cmath>
#include <regex>

#include "bie/physics/averaged_field.hpp"
#include "bie/scene/units.hpp"
#include "tests/app/sweep_folder.hpp"

// Compares the phase diagram of docs/sweeps/ac_shapes.toml with the sphere's drive, whose sign is known in closed form.
BOOST_AUTO_TEST_SUITE(ac_border, *boost::unit_test::label("once"))

namespace {

/// Drive Q of the sphere of docs/sweeps/ac_scene.toml. @param conductivity  of the interior, S/m
double drive(double frequency, double conductivity) {
  constexpr double permittivity = 80.0 * 8.8541878128e-12;
  vehd::ElectricParameters electric{{0.0, 0.0, 1e4}, conductivity, 1e-3, permittivity, 1.0};
  electric.displacement_current = true;
  electric.averaged_frequency = frequency;
  return vehd::sphere_in_ac_field(electric, {0.01, 0.0}, 1e-5).drive;
}

double number(const std::string& text) { return vehd::parse_quantity(text)->number; }

/// Ratio of the frequencies at both ends of one cell of the diagram.
const double one_cell = std::pow(1e6, 1.0 / 19.0);

}  // namespace

BOOST_AUTO_TEST_CASE(the_drawn_curve_is_where_a_sphere_changes_its_direction) {
  std::istringstream text(file_text(VEHD_SOURCE_DIR "/docs/sweeps/ac_border.csv"));
  std::string line;
  std::getline(text, line);
  int count = 0;
  for (; std::getline(text, line); ++count) {
    const auto cells = vehd::csv_cells(line);
    const double frequency = number(cells[0]), conductivity = 1e-4 * number(cells[1]);
    BOOST_TEST(drive(0.999 * frequency, conductivity) * drive(1.001 * frequency, conductivity) < 0.0, line);
  }
  BOOST_TEST(count > 50);
}

BOOST_AUTO_TEST_CASE(vesicles_change_their_direction_within_a_cell_of_it) {
  // Zeros of Q for 1 and 5 uS/cm, correct to their last digit (drive above, and tests/physics/averaged_field_test.cpp).
  // This end time suffices to show the direction in which the shapes deform.
  const SweepWork work(
      std::regex_replace(file_text(VEHD_SOURCE_DIR "/docs/sweeps/ac_scene.toml"), std::regex("2.4 s"), "0.8 s"));
  std::string frequencies, conductivities;
  std::vector<double> drives;
  for (const auto& [conductivity, zeros] : {std::pair{1.0, std::array{95.5, 2.222e6}}, {5.0, {604.6, 1.755e6}}}) {
    for (const double zero : zeros) {
      for (const double frequency : {zero / one_cell, zero * one_cell}) {
        frequencies += fmt::format("\"{} Hz\", ", frequency);
        conductivities += fmt::format("\"{} uS/cm\", ", conductivity);
        drives.push_back(drive(frequency, 1e-4 * conductivity));
      }
    }
  }
  work.write_sweep("\"electric.waveform.frequency\" = {values = [" + frequencies +
                       "]}\n\"electric.conductivity_in\" = {values = [" + conductivities + "]}\n",
                   "mode = \"zip\"\ncolumns = [\"aspect_ratio_field\"]\n");
  const ProgramResult result = work.run({"--jobs", "1"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const auto ratios = work.column("aspect_ratio_field");
  BOOST_TEST_REQUIRE(ratios.size() == drives.size());
  for (std::size_t i = 0; i < drives.size(); ++i) {
    BOOST_TEST((std::stod(ratios[i]) > 1.0) == (drives[i] > 0.0), i << ": " << ratios[i]);
  }
}

BOOST_AUTO_TEST_SUITE_END()
