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
  checkpoint.state.dt_found = 1.0 / 7.0;
  checkpoint.state.vesicles.emplace_back();
  checkpoint.state.vesicles[0].position = vehd::Matrix::Random(25, 3);
  checkpoint.state.vesicles[0].position(0, 0) = std::numeric_limits<double>::denorm_min();
  checkpoint.state.vesicles[0].tension = vehd::Vector::Random(25);
  checkpoint.state.vesicles[0].area_strain = vehd::Vector::Random(25);
  checkpoint.state.vesicles[0].reference_area = 12.0;
  std::vector<vehd::Index> entries(25);
  std::iota(entries.begin(), entries.end(), vehd::Index{0});
  checkpoint.state.vesicles[0].recycled.flow =
      vehd::recycled_scalars(entries, {vehd::Matrix::Random(50, 3), vehd::Matrix::Random(50, 3)});
  checkpoint.state.vesicles[0].recycled.unaided_iterations = 21;
  checkpoint.state.vesicles[0].recycled.pause = 5;
  checkpoint.state.past_times = vehd::Vector{{-1.0 / 3.0, -0.1}};
  checkpoint.state.vesicles[0].past = vehd::Matrix::Random(25, 6);
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
  BOOST_TEST(read.state.dt_found == written.state.dt_found);
  BOOST_TEST((read.state.past_times == written.state.past_times));
  BOOST_TEST((read.state.vesicles[0].past == written.state.vesicles[0].past));
  BOOST_TEST((read.state.vesicles[0].position == written.state.vesicles[0].position));
  BOOST_TEST((read.state.vesicles[0].tension == written.state.vesicles[0].tension));
  BOOST_TEST((read.state.vesicles[0].area_strain == written.state.vesicles[0].area_strain));
  BOOST_TEST(read.state.vesicles[0].transmembrane_potential.size() == 0);
  const vehd::RecycledScalars& known = *read.state.vesicles[0].recycled.flow;
  BOOST_TEST((known.entries() == written.state.vesicles[0].recycled.flow->entries()));
  BOOST_TEST((known.subspace().arguments == written.state.vesicles[0].recycled.flow->subspace().arguments));
  BOOST_TEST((known.subspace().responses == written.state.vesicles[0].recycled.flow->subspace().responses));
  BOOST_TEST(!read.state.vesicles[0].recycled.tension);
  BOOST_TEST(read.state.vesicles[0].recycled.unaided_iterations == 21);
  BOOST_TEST(read.state.vesicles[0].recycled.pause == 5);
  BOOST_TEST(read.state.vesicles[0].reference_area == written.state.vesicles[0].reference_area);
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
      // The byte is padding or part of a description.
      BOOST_TEST_REQUIRE((read.state.vesicles[0].position == written.state.vesicles[0].position));
      BOOST_TEST_REQUIRE((read.state.vesicles[0].tension == written.state.vesicles[0].tension));
      BOOST_TEST_REQUIRE(read.state.time == written.state.time);
    } catch (const vehd::InputError&) {
      ++refused;
    }
  }
  BOOST_TEST(refused > 50);
}

BOOST_AUTO_TEST_SUITE_END()
