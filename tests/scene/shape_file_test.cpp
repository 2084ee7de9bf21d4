#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "bie/files/run_file.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/rotation.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(shape_file)

namespace {

using vehd::Index;
using vehd::Matrix;
using vehd::Vector;

constexpr int stored_order = 6;

const std::string ellipsoid = "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.5, 2.0]\n";
const std::string electric =
    "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n";
const std::string numerics =
    "[numerics]\norder = 6\ndt = 1\nend_time = 1\n[membrane]\ncapacitance = 1\n[fluid]\nviscosity = 1\n";

std::string units_text(const vehd::UnitsScene& units) {
  std::string text = "[units]\n";
  const auto add = [&](const char* name, const std::optional<double>& value, const char* unit) {
    if (value) text += fmt::format("{} = \"{} {}\"\n", name, *value, unit);
  };
  add("length", units.length, "m");
  add("time", units.time, "s");
  add("viscosity", units.viscosity, "Pa s");
  add("potential", units.potential, "V");
  return text;
}

/// A run.h5 with snapshots at its times 0, 1, 2, ... 4, each larger by half than the previous one, and V_m proportional
/// to the number of the snapshot plus one.
class StoredRun {
 public:
  /// @param moved  changes each position before it is stored; empty: none
  explicit StoredRun(const std::string& scene, const std::function<Matrix(const Matrix&)>& moved = {}) {
    const vehd::SphereTransform transform(stored_order, vehd::make_grid(stored_order));
    const vehd::Scene parsed = vehd::parse_scene(scene, "stored.toml", directory_ / "");
    vehd::Hdf5Writer file(path(), vehd::Hdf5Writer::Mode::create);
    vehd::write_run_header(file, transform, {vehd::effective_scene(parsed), 1, vehd::si_units_of(parsed.units)});
    (void)file.seal("/");
    for (int number = 0; number < 5; ++number) {
      vehd::State state;
      state.time = number;
      state.vesicles.emplace_back();
      state.vesicles[0].position = position(number);
      if (moved) state.vesicles[0].position = moved(position(number));
      if (parsed.electric) state.vesicles[0].transmembrane_potential = potential(number);
      state.vesicles[0].area_strain = Vector::Zero(state.vesicles[0].position.rows());
      vehd::write_snapshot(file, vehd::snapshot_name(number), transform, state,
                           vehd::Fields{std::vector<vehd::VesicleFields>(1)}, vehd::si_units_of(parsed.units));
    }
    file.close();
  }

  [[nodiscard]] std::string path() const { return directory_ / "run.h5"; }

  [[nodiscard]] static Matrix position(int number) {
    const vehd::Scene scene = vehd::parse_scene(ellipsoid + numerics, "shape.toml", "");
    Matrix position = std::pow(1.5, number) * vehd::initial_position(scene);
    position(vehd::coefficient_index(3, 2), 0) = 0.1;
    return position;
  }
  [[nodiscard]] static Vector potential(int number) {
    Vector potential = Vector::Zero(vehd::n_coefficients(stored_order));
    potential(vehd::coefficient_index(1, 0)) = 1.0 + number;
    potential(vehd::coefficient_index(2, 1)) = -0.25 * (1.0 + number);
    return potential;
  }

  /// Scene that starts from the run. @param before, shape  lines before [shape] and in it
  [[nodiscard]] std::string scene(const std::string& before, const std::string& shape = "",
                                  const std::string& after = electric) const {
    return before + "[shape]\nkind = \"file\"\npath = \"run.h5\"\n" + shape + after + numerics;
  }
  [[nodiscard]] vehd::Scene parsed(const std::string& text) const {
    return vehd::parse_scene(text, "scene.toml", directory_ / "");
  }
  [[nodiscard]] vehd::InitialMembrane membrane(const std::string& text) const {
    return vehd::initial_membrane(parsed(text));
  }
  /// The error that the scene causes, with the file name abbreviated; empty if it causes none.
  [[nodiscard]] std::string message(const std::string& text) const {
    try {
      (void)membrane(text);
    } catch (const vehd::InputError& error) {
      std::string message = error.what();
      for (std::size_t at; (at = message.find(path())) != std::string::npos;)
        message.replace(at, path().size(), "FILE");
      return message;
    }
    return "";
  }

 private:
  TemporaryDirectory directory_;
};

double difference(const Matrix& a, const Matrix& b) { return (a - b).norm() / b.norm(); }

vehd::UnitsScene random_units(std::mt19937& random) {
  const auto scale = [&] { return std::pow(10.0, std::uniform_real_distribution<double>(-9.0, 3.0)(random)); };
  return {scale(), scale(), scale(), scale()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_snapshot_is_taken_over_at_any_order) {
  const StoredRun run(ellipsoid + numerics);
  for (const int order : {4, 6, 12}) {
    std::string text = run.scene("", "time = 2\n", "");
    text.replace(text.find("order = 6"), 9, fmt::format("order = {}", order));
    BOOST_TEST((run.membrane(text).position == vehd::resize_order(StoredRun::position(2), order)));
  }
}

BOOST_AUTO_TEST_CASE(a_snapshot_can_be_scaled_rotated_and_moved_and_its_potential_turns_with_it) {
  const StoredRun run(ellipsoid + electric + numerics);
  const auto placed =
      run.membrane(run.scene("", "time = 0\nscale = 1.5\nrotation = [1, 1, 0, 25]\ncentre = [0, 0, 1]\n"));
  const vehd::Matrix3 rotation = vehd::rotation_matrix({1, 1, 0, 25});
  const Matrix expected = vehd::shifted(vehd::rotated(1.5 * StoredRun::position(0), rotation), {0, 0, 1});
  BOOST_TEST(difference(placed.position, expected) < 1e-13);
  // V_m at a point of the body is unchanged.
  const vehd::Vector3 before = vehd::Vector3(0.3, -0.5, 0.7).normalized(), after = rotation * before;
  const auto at = [](const Vector& coefficients, const vehd::Vector3& s) {
    return vehd::evaluate_harmonics(coefficients, Vector{{std::acos(s.z())}}, Vector{{std::atan2(s.y(), s.x())}})(0, 0);
  };
  BOOST_TEST(at(placed.potential, after) == at(StoredRun::potential(0), before), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_snapshot_reaches_a_reduced_volume_wherever_the_vesicle_and_its_membrane_have_moved) {
  const auto move = [](const Matrix& position) -> Matrix {
    return vehd::shifted(vehd::rotated_fields(position, vehd::rotation_matrix({1, -2, 0.5, 130})), {5.0, 0.0, -2.0});
  };
  const StoredRun run(ellipsoid + numerics), moved(ellipsoid + numerics, move);
  for (const double volume : {0.9, 0.97}) {
    const double excess = 4.0 * std::numbers::pi * (std::pow(volume, -2.0 / 3.0) - 1.0);
    const std::string shape = fmt::format("time = 0\nreduced_volume = {}\n", volume);
    const Matrix position = run.membrane(run.scene("", shape, "")).position;
    const vehd::ShapeSize size = vehd::size_of(position);
    BOOST_TEST(6.0 * std::sqrt(std::numbers::pi) * size.volume / std::pow(size.area, 1.5) == volume,
               boost::test_tools::tolerance(1e-11));
    const std::string same = fmt::format("time = 0\nexcess_area = {}\n", excess);
    BOOST_TEST(difference(run.membrane(run.scene("", same, "")).position, position) < 1e-9);
    BOOST_TEST(difference(moved.membrane(moved.scene("", shape, "")).position, move(position)) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(lengths_times_and_potentials_are_those_of_the_file_in_any_units) {
  std::mt19937 random(7);
  for (int repeat = 0; repeat < 8; ++repeat) {
    const vehd::UnitsScene of_file = random_units(random), of_scene = random_units(random);
    const StoredRun run(units_text(of_file) + ellipsoid + electric + numerics);
    for (int number = 0; number < 5; ++number) {
      const double seconds = number * *of_file.time;
      for (const std::string& time : {fmt::format("\"{} s\"", seconds), fmt::format("{}", seconds / *of_scene.time)}) {
        const auto membrane = run.membrane(run.scene(units_text(of_scene), "time = " + time + "\n"));
        BOOST_TEST(difference(membrane.position * *of_scene.length, StoredRun::position(number) * *of_file.length) <
                   1e-14);
        BOOST_TEST(difference(membrane.potential * *of_scene.potential,
                              StoredRun::potential(number) * *of_file.potential) < 1e-14);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(numbers_without_units_on_both_sides_stay_as_they_are) {
  const StoredRun run(ellipsoid + electric + numerics);
  const auto membrane = run.membrane(run.scene("", "time = 3\n"));
  BOOST_TEST((membrane.position == StoredRun::position(3)));
  BOOST_TEST((membrane.potential == StoredRun::potential(3)));
}

BOOST_AUTO_TEST_CASE(a_time_between_snapshots_is_refused_however_small_it_is) {
  const StoredRun run(units_text({1e-6, 1e-9, 1e-3, 1.0}) + ellipsoid + numerics);
  const std::string units = units_text({1e-6, 1.0, 1e-3, 1.0});
  BOOST_TEST(run.message(run.scene(units, "time = \"2 ns\"\n", "")) == "");
  BOOST_TEST(run.message(run.scene(units, "time = \"2.4 ns\"\n", "")) ==
             "scene.toml:9: \"time\" in [shape] is 2.4 ns, at which FILE has no snapshot; the nearest is at 2 ns");
}

BOOST_AUTO_TEST_CASE(units_on_one_side_alone_are_refused_where_they_matter) {
  const std::string units = units_text({1e-5, 1e-3, 1e-3, 0.1});
  const StoredRun with(units + ellipsoid + electric + numerics), without(ellipsoid + electric + numerics);
  BOOST_TEST(with.message(with.scene("")) ==
             "scene.toml:3: \"path\" in [shape] needs a reference length, which FILE has but this scene lacks; "
             "accepted: \"length\" in [units], or \"area\" in [shape], which sets the size");
  BOOST_TEST(without.message(without.scene(units)) ==
             "scene.toml:8: \"path\" in [shape] needs a reference length, which this scene has but FILE lacks; "
             "accepted: a run of a scene with [units], or \"area\" in [shape], which sets the size");
  BOOST_TEST(with.message(with.scene("", "area = 12\ntime = 1\n")) ==
             "scene.toml:5: \"time\" in [shape] needs a reference time, which FILE has but this scene lacks; "
             "accepted: \"time\" in [units], or no \"time\", for the last snapshot");
  BOOST_TEST(without.message(without.scene(units, "area = 12\n")) ==
             "scene.toml:10: \"initial_Vm\" in [electric] needs a reference potential, which this scene has but FILE "
             "lacks; accepted: a run of a scene with [units], or \"initial_Vm\" zero or steady");
  // If the scene states an area and a potential of its own, it needs none of the scales.
  const std::string zero = electric + "initial_Vm = \"zero\"\n";
  for (const StoredRun* run : {&with, &without}) {
    const std::string before = run == &with ? "" : units;
    BOOST_TEST(run->message(run->scene(before, "area = 12\n", zero)) == "");
    BOOST_TEST(vehd::size_of(run->membrane(run->scene(before, "area = 12\n", zero)).position).area == 12.0,
               boost::test_tools::tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(the_potential_of_the_file_is_the_default_where_there_is_one) {
  const StoredRun charged(ellipsoid + electric + numerics), plain(ellipsoid + numerics);
  const auto start = [](const StoredRun& run, const std::string& word) {
    return run.parsed(run.scene("", "", word.empty() ? electric : electric + "initial_Vm = \"" + word + "\"\n"))
        .electric->initial_potential;
  };
  using vehd::InitialPotential;
  BOOST_TEST((start(charged, "") == InitialPotential::file));
  BOOST_TEST((start(charged, "file") == InitialPotential::file));
  BOOST_TEST((start(charged, "zero") == InitialPotential::zero));
  BOOST_TEST((start(charged, "steady") == InitialPotential::steady));
  BOOST_TEST((start(plain, "") == InitialPotential::zero));
  BOOST_TEST(charged.membrane(charged.scene("", "", electric + "initial_Vm = \"zero\"\n")).potential.size() == 0);
  const vehd::Scene scene = charged.parsed(charged.scene(""));
  BOOST_TEST((charged.parsed(vehd::effective_scene(scene)) == scene));
  BOOST_TEST(vehd::effective_scene(scene).find("initial_Vm = \"file\"\n") != std::string::npos);
  BOOST_TEST((vehd::problem_of(scene).start[0].potential.given == StoredRun::potential(4)));
}

BOOST_AUTO_TEST_CASE(a_potential_that_no_file_has_is_refused) {
  const StoredRun plain(ellipsoid + numerics);
  const std::string from_file = electric + "initial_Vm = \"file\"\n";
  BOOST_TEST(plain.message(plain.scene("", "", from_file)) ==
             "scene.toml:9: \"initial_Vm\" in [electric] is file, but FILE has no V_m; accepted: zero, steady");
  BOOST_TEST(
      plain.message(ellipsoid + from_file + numerics) ==
      "scene.toml:9: \"initial_Vm\" in [electric] is file, but the shape is not from a file; accepted: zero, steady");
}

BOOST_AUTO_TEST_CASE(the_effective_scene_fixes_the_shape_of_a_file_that_may_change) {
  const StoredRun run(ellipsoid + numerics), other(ellipsoid + electric + numerics);
  const std::string text = run.scene("", "", "");
  const auto effective = [&](const std::string& scene) { return vehd::effective_scene(run.parsed(scene)); };
  const std::string fixed = effective(text);
  BOOST_TEST(fixed.find("\ntime = 4.0\n") != std::string::npos, fixed);
  BOOST_TEST(effective(fixed) == fixed);
  BOOST_TEST(effective(run.scene("", "time = 4\n", "")) == fixed);
  std::filesystem::copy_file(other.path(), run.path(), std::filesystem::copy_options::overwrite_existing);
  BOOST_TEST(effective(text) != fixed);
  BOOST_TEST(run.message(fixed).ends_with("\"checksum\" in [shape] is not that of FILE, which has changed"),
             run.message(fixed));
}

BOOST_AUTO_TEST_CASE(every_dataset_has_the_factor_to_si_units) {
  const vehd::UnitsScene units{2.0, 3.0, 5.0, 7.0};
  const StoredRun with(units_text(units) + ellipsoid + electric + numerics), without(ellipsoid + electric + numerics);
  const vehd::Hdf5Reader file(with.path()), plain(without.path());
  const auto tolerance = boost::test_tools::tolerance(1e-15);
  for (const std::string part : {"", "coefficients/", "surface/"}) {
    const std::string group = "/snapshots/000000/" + part;
    BOOST_TEST(file.number_attribute(group + "x", "scale") == 2.0, tolerance);
    BOOST_TEST(file.text_attribute(group + "x", "unit") == "m");
    BOOST_TEST(file.text_attribute(group + "x", "dimension") == "length");
    BOOST_TEST(file.number_attribute(group + "Vm", "scale") == 7.0, tolerance);
    BOOST_TEST(file.text_attribute(group + "Vm", "unit") == "V");
    BOOST_TEST(plain.number_attribute(group + "x", "scale") == 1.0);
    BOOST_TEST(plain.text_attribute(group + "x", "unit") == "1");
    BOOST_TEST(plain.text_attribute(group + "x", "dimension") == "length");
  }
  BOOST_TEST(file.number_attribute("/snapshots/000000/area_element", "scale") == 4.0, tolerance);
  BOOST_TEST(file.text_attribute("/snapshots/000000/area_element", "unit") == "m^2");
  BOOST_TEST(file.number_attribute("/snapshots/000000/area_strain", "scale") == 1.0);
  BOOST_TEST(file.text_attribute("/snapshots/000000/area_strain", "unit") == "1");
  BOOST_TEST(file.text_attribute("/grid/theta", "unit") == "rad");
  for (const char* dataset : {"/grid/weight", "/surface/triangles", "/coefficients_convention/degree"}) {
    BOOST_TEST(file.number_attribute(dataset, "scale") == 1.0);
    BOOST_TEST(file.text_attribute(dataset, "unit") == "1");
  }
  BOOST_TEST(file.number_attribute("/snapshots", "time_scale") == 3.0, tolerance);
  BOOST_TEST(file.text_attribute("/snapshots", "time_unit") == "s");
  BOOST_TEST(plain.number_attribute("/snapshots", "time_scale") == 1.0);
  BOOST_TEST(plain.text_attribute("/snapshots", "time_unit") == "1");
}

BOOST_AUTO_TEST_SUITE_END()
