#include <boost/test/unit_test.hpp>

#include "bie/files/hdf5_writer.hpp"
#include "bie/files/run_reader.hpp"
#include "tests/app/program.hpp"

namespace {

/// Requires a refusal in one line, before memory is allocated: the program itself needs some 30 MB, several times that
/// under a sanitizer.
void check_cheaply_refused(const std::vector<std::string>& arguments, const std::string& part) {
  const ProgramResult result = run_vehd(arguments);
  BOOST_TEST(result.exit_code == 1, result.errors);
  BOOST_TEST(result.errors.find(part) != std::string::npos, result.errors);
  BOOST_TEST(std::count(result.errors.begin(), result.errors.end(), '\n') == 1, result.errors);
  BOOST_TEST(result.peak_kilobytes < 400000);
}

/// Writes a run.h5 whose position claims these extents.
/// @param chunk  extents of its deflated chunks; empty: contiguous
void write_hollow_run(const std::string& path, const std::vector<hsize_t>& extents, bool allocated,
                      const std::vector<hsize_t>& chunk = {}) {
  {
    vehd::Hdf5Writer file(path, vehd::Hdf5Writer::Mode::create);
    file.attribute("/", "schema_version", vehd::run_schema_version);
    for (const char* group : {"/snapshots", "/snapshots/000000", "/snapshots/000000/coefficients"}) file.group(group);
    file.attribute("/snapshots/000000", "time", 0.0);
    file.close();
  }
  const vehd::Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  const vehd::Hdf5Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose);
  const vehd::Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_fill_time(properties.id(), H5D_FILL_TIME_NEVER);
  if (!chunk.empty()) {
    H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(properties.id());
    H5Pset_deflate(properties.id(), 1);
  }
  if (allocated) H5Pset_alloc_time(properties.id(), H5D_ALLOC_TIME_EARLY);
  const vehd::Hdf5Handle dataset(H5Dcreate2(file.id(), "/snapshots/000000/coefficients/x", H5T_IEEE_F64LE, space.id(),
                                            H5P_DEFAULT, properties.id(), H5P_DEFAULT),
                                 H5Dclose);
  BOOST_TEST_REQUIRE(dataset.valid());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(hostile_size, *boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(scenes_that_ask_for_too_much) {
  const TemporaryDirectory directory;
  const std::string start = "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 2]\n[numerics]\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"order = 1000000000\ndt = 1\nend_time = 1\n", ":5: \"order\" in [numerics] is 1000000000; accepted: "},
      {"dt = 1e-12\nend_time = 1\n", ":5: \"dt\" in [numerics] makes 1e+12 steps; accepted: at most 1e+09"},
      {"dt = 1\nend_time = 1\n[output]\nevery = 1e-12\n", "makes 1e+12 snapshots; accepted: at most 999999"}};
  for (const auto& [text, part] : cases) {
    write_text(directory / "scene.toml", start + text);
    for (const char* command : {"run", "plan"}) {
      std::vector<std::string> arguments = {command, directory / "scene.toml"};
      if (std::string(command) == "run") arguments.insert(arguments.end(), {"-o", directory / "out"});
      check_cheaply_refused(arguments, part);
    }
    BOOST_TEST(!std::filesystem::exists(directory / "out"));
  }
}

BOOST_AUTO_TEST_CASE(shape_files_that_claim_too_much) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml",
             "[shape]\nkind = \"file\"\npath = \"run.h5\"\n[numerics]\ndt = 1\nend_time = 0\n");
  const std::vector<std::string> arguments = {"run", directory / "scene.toml", "-o", directory / "out"};
  const std::string dataset = "run.h5: dataset /snapshots/000000/coefficients/x ";
  const auto check = [&](const std::vector<hsize_t>& extents, bool allocated, const std::string& part) {
    write_hollow_run(directory / "run.h5", extents, allocated);
    check_cheaply_refused(arguments, part);
  };
  check({3, hsize_t{1} << 36}, false, dataset + "claims more numbers than the file stores");
  // A sparse file can be that large.
  check({3, hsize_t{1} << 36}, true, dataset + "has 206158430208 numbers; accepted: at most 2097152");
  write_hollow_run(directory / "run.h5", {3, 1 << 26}, false, {3, 1 << 26});
  check_cheaply_refused(arguments, dataset + "claims more numbers than the file stores");
  write_hollow_run(directory / "run.h5", {3, hsize_t{1} << 36}, false, {3, 1 << 10});
  check_cheaply_refused(arguments, dataset + "has an unknown layout");
  check({3, 101 * 101}, true, "run.h5: /snapshots/000000/coefficients/x is of degree 100; accepted: at most 64");
}

BOOST_AUTO_TEST_SUITE_END()
