#include "bie/runs/checkpoint.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <numeric>

#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"

namespace {

vehd::Checkpoint sample() {
  vehd::Checkpoint checkpoint;
  checkpoint.scene = "[shape]\n";
  checkpoint.start_order = 16;
  checkpoint.changes = {{0.05, 3, "numerics.dt", 0.1, 1.0 / 3.0}, {0.05, 3, "numerics.tolerance", nullptr, 1e-3}};
  checkpoint.state.time = 0.1;
  checkpoint.state.step = 7;
  checkpoint.state.dt_next = 1.0 / 3.0;
  checkpoint.state.position = vehd::Matrix::Random(25, 3);
  checkpoint.state.position(0, 0) = std::numeric_limits<double>::denorm_min();
  checkpoint.state.tension = vehd::Vector::Random(25);
  checkpoint.state.area_strain = vehd::Vector::Random(25);
  checkpoint.state.reference_area = 12.0;
  std::vector<vehd::Index> entries(25);
  std::iota(entries.begin(), entries.end(), vehd::Index{0});
  checkpoint.state.flow_memory.flow =
      vehd::remembered(entries, {vehd::Matrix::Random(50, 3), vehd::Matrix::Random(50, 3)});
  checkpoint.state.flow_memory.unaided_iterations = 21;
  checkpoint.state.flow_memory.pause = 5;
  checkpoint.n_rows = 8;
  checkpoint.history_bytes = 1234;
  checkpoint.n_snapshots = 3;
  checkpoint.totals.seconds = 1.5;
  checkpoint.totals.kernel_evaluations["stokeslet"] = 1ULL << 60;
  return checkpoint;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(checkpoint)

BOOST_AUTO_TEST_CASE(every_bit_comes_back) {
  const TemporaryDirectory directory;
  const vehd::Checkpoint written = sample();
  vehd::write_checkpoint(directory / "checkpoint.h5", written);
  const vehd::Checkpoint read = vehd::read_checkpoint(directory / "checkpoint.h5");
  BOOST_TEST(read.scene == written.scene);
  BOOST_TEST(read.start_order == written.start_order);
  BOOST_TEST((read.changes == written.changes));
  BOOST_TEST(read.state.time == written.state.time);
  BOOST_TEST(read.state.step == written.state.step);
  BOOST_TEST(read.state.dt_next == written.state.dt_next);
  BOOST_TEST((read.state.position == written.state.position));
  BOOST_TEST((read.state.tension == written.state.tension));
  BOOST_TEST((read.state.area_strain == written.state.area_strain));
  BOOST_TEST(read.state.transmembrane_potential.size() == 0);
  const vehd::ScalarResponses& known = *read.state.flow_memory.flow;
  BOOST_TEST((known.entries() == written.state.flow_memory.flow->entries()));
  BOOST_TEST((known.known().arguments == written.state.flow_memory.flow->known().arguments));
  BOOST_TEST((known.known().responses == written.state.flow_memory.flow->known().responses));
  BOOST_TEST(!read.state.flow_memory.tension);
  BOOST_TEST(read.state.flow_memory.unaided_iterations == 21);
  BOOST_TEST(read.state.flow_memory.pause == 5);
  BOOST_TEST(read.state.reference_area == written.state.reference_area);
  BOOST_TEST(read.n_rows == written.n_rows);
  BOOST_TEST(read.history_bytes == written.history_bytes);
  BOOST_TEST(read.n_snapshots == written.n_snapshots);
  BOOST_TEST(read.totals.kernel_evaluations.at("stokeslet") == 1ULL << 60);
}

BOOST_AUTO_TEST_CASE(no_damage_is_read_in_silence) {
  const TemporaryDirectory directory;
  const std::string path = directory / "checkpoint.h5";
  const vehd::Checkpoint written = sample();
  vehd::write_checkpoint(path, written);
  const std::string original = file_text(path);
  int refused = 0;
  for (std::size_t place = 0; place < original.size(); place += 13) {
    std::string altered = original;
    altered[place] = static_cast<char>(altered[place] ^ 0x11);
    write_text(path, altered);
    try {
      const vehd::Checkpoint read = vehd::read_checkpoint(path);
      // The byte belonged to padding or to a description.
      BOOST_TEST_REQUIRE((read.state.position == written.state.position));
      BOOST_TEST_REQUIRE((read.state.tension == written.state.tension));
      BOOST_TEST_REQUIRE(read.state.time == written.state.time);
    } catch (const vehd::InputError&) {
      ++refused;
    }
  }
  BOOST_TEST(refused > 50);
}

BOOST_AUTO_TEST_SUITE_END()
