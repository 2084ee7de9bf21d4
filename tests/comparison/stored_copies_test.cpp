#include "bie/comparison/stored_copies.hpp"

#include <hdf5.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <string>
#include <vector>

#include "bie/runs/run_loop.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/shipped_scenes.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/seals.hpp"

namespace {

/// Scenes with units, amplitudes, two vesicles, pores and spatially varying properties among them.
const std::vector<std::string> scenes = {"ac_field_averaged", "figure2", "two_prolates",
                                         "poration",          "pump",    "relaxation"};

struct WrittenRun {
  TemporaryDirectory directory;
  std::string file = directory / "out/run.h5";

  /// Writes the start of a shipped scene at a low degree.
  explicit WrittenRun(const std::string& name) {
    const auto shipped = std::ranges::find(vehd::shipped_scenes(), name, &vehd::ShippedScene::name);
    const vehd::Scene scene = vehd::parse_scene(shortened_scene(std::string(shipped->text)), name, directory / "");
    const vehd::RunPaths paths{directory / "out"};
    vehd::make_directory(paths.directory);
    vehd::RecordedRun run({scene, paths, std::nullopt});
    run.start();
    run.end({.completed = false, .reason = "of a test"});
  }

  /// Paths of the copies: of all datasets but the coefficients, which are the originals.
  [[nodiscard]] std::vector<std::string> copies() const {
    const vehd::Hdf5Reader reader{std::filesystem::path(file)};
    std::vector<std::string> paths;
    for (const auto& [path, checksum] : reader.object_checksums("/")) {
      if (reader.has_attribute(path, "scale") && path.find("/coefficients/") == std::string::npos) {
        paths.push_back(path);
      }
    }
    return paths;
  }

  /// Renews the checksums, as if a faulty program had written the file.
  void seal() const {
    vehd::testing::reseal(file, "/");
    vehd::testing::reseal(file, "/snapshots/000000");
  }

  [[nodiscard]] std::string refusal() const {
    try {
      vehd::require_copies(vehd::RunReader(std::filesystem::path(file)), 0);
    } catch (const vehd::InputError& error) {
      return error.what();
    }
    return "";
  }
};

/// Multiplies a dataset by a factor. @return whether that changes any value
bool scale(const std::string& file, const std::string& dataset, double factor) {
  const vehd::Hdf5Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const vehd::Hdf5Handle data(H5Dopen2(handle.id(), dataset.c_str(), H5P_DEFAULT), H5Dclose);
  const vehd::Hdf5Handle space(H5Dget_space(data.id()), H5Sclose);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id())));
  H5Dread(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  const std::vector<double> before = values;
  for (double& value : values) value *= factor;
  BOOST_TEST_REQUIRE(H5Dwrite(data.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  return values != before;
}

/// Replaces the attribute of this name.
void set_attribute(const std::string& file, const std::string& object, const char* name, double value) {
  const vehd::Hdf5Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  BOOST_TEST_REQUIRE(H5Adelete_by_name(handle.id(), object.c_str(), name, H5P_DEFAULT) >= 0);
  const vehd::Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const vehd::Hdf5Handle attribute(H5Acreate_by_name(handle.id(), object.c_str(), name, H5T_IEEE_F64LE, space.id(),
                                                     H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                   H5Aclose);
  BOOST_TEST_REQUIRE(H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, &value) >= 0);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(stored_copies)

BOOST_AUTO_TEST_CASE(every_copy_that_does_not_follow_from_coefficients_is_named) {
  for (const std::string& scene : scenes) {
    BOOST_TEST_INFO_SCOPE(scene);
    const WrittenRun run(scene);
    BOOST_TEST(run.refusal() == "");
    const std::string intact = file_text(run.file);
    const std::vector<std::string> copies = run.copies();
    BOOST_TEST(copies.size() > 15U);
    for (const std::string& copy : copies) {
      for (const double factor : {2.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        // A factor does not change zeros.
        if (!scale(run.file, copy, factor)) continue;
        run.seal();
        const std::string refusal = run.refusal();
        BOOST_TEST(refusal.find(copy + " has ") != std::string::npos, copy << " times " << factor << ": " << refusal);
        write_text(run.file, intact);
      }
      set_attribute(run.file, copy, "scale", 3.0);
      run.seal();
      BOOST_TEST(run.refusal().find(copy + " has another unit or scale") != std::string::npos, copy);
      write_text(run.file, intact);
    }
    set_attribute(run.file, "/snapshots", "time_scale", 3.0);
    run.seal();
    BOOST_TEST(run.refusal().find("/snapshots has another time_unit or time_scale") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(a_copy_without_its_coefficients_and_one_that_is_missing_are_named) {
  const WrittenRun run("figure2");
  const std::string intact = file_text(run.file);
  const auto remove = [&](const std::string& dataset) {
    write_text(run.file, intact);
    {
      const vehd::Hdf5Handle handle(H5Fopen(run.file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
      BOOST_TEST_REQUIRE(H5Ldelete(handle.id(), dataset.c_str(), H5P_DEFAULT) >= 0);
    }
    run.seal();
    return run.refusal();
  };
  BOOST_TEST(remove("/snapshots/000000/surface/Vm").find("/surface/Vm is missing") != std::string::npos);
  BOOST_TEST(remove("/grid/weight").find("/grid/weight is missing") != std::string::npos);
  BOOST_TEST(remove("/snapshots/000000/coefficients/force_electric").find("force_electric has no coefficients") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
