#include <boost/test/unit_test.hpp>

#include "bie/files/run_reader.hpp"
#include "bie/runs/session.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/file_system.hpp"
#include "tests/support/files.hpp"
#include "tests/support/forked_ranks.hpp"

BOOST_AUTO_TEST_SUITE(runs_on_ranks)

namespace {

using vehd::Ranks;
using vehd::testing::on_ranks;

/// Three vesicles without symmetry in shear and field, each of its own size, one with another fluid.
std::string three_vesicles(const std::string& numerics) {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 0.9, 1.2]\n"
         "[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
         "[flow]\nkind = \"shear\"\nrate = 1.0\n"
         "[electric]\nfield = [0.0, 0.3, 0.5]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
         "[[vesicle]]\n[vesicle.shape]\ncentre = [-1.6, 0.0, 0.3]\n"
         "[[vesicle]]\n[vesicle.shape]\ncentre = [1.4, 0.2, 0.0]\nscale = 0.8\n[vesicle.fluid]\nviscosity_ratio = 2.0\n"
         "[[vesicle]]\n[vesicle.shape]\ncentre = [0.1, 2.3, 0.9]\nscale = 0.7\n"
         "[output]\nevery = 0.1\n[numerics]\n" +
         numerics;
}

/// Four vesicles, of which two are images of others.
const std::string kTwoPairs =
    "[shape]\nkind = \"radial\"\nmodes = [{n = 2, m = 1, a = 0.2}, {n = 3, m = -2, a = 0.1}]\n"
    "[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n[flow]\nkind = \"shear\"\nrate = 1.0\n"
    "[fluid]\nviscosity_ratio = 2.0\n"
    "[electric]\nfield = [0.0, 0.3, 0.5]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
    "[[vesicle]]\n[vesicle.shape]\ncentre = [1.8, 0.1, 0.4]\n"
    "[[vesicle]]\n[vesicle.shape]\ncentre = [-0.1, 2.0, 0.9]\nscale = 0.8\n"
    "[[vesicle]]\n[vesicle.shape]\ncentre = [-1.8, -0.1, -0.4]\n"
    "modes = [{n = 2, m = 1, a = 0.2}, {n = 3, m = -2, a = -0.1}]\n"
    "[[vesicle]]\n[vesicle.shape]\ncentre = [0.1, -2.0, -0.9]\nscale = 0.8\n"
    "modes = [{n = 2, m = 1, a = 0.2}, {n = 3, m = -2, a = -0.1}]\n"
    "[numerics]\norder = 4\ntime_order = 2\ndt = 0.1\nend_time = 0.1\n[output]\nevery = 0.1\n";

/// Two vesicles with displacement currents in a pulse, with different sizes, fluids and membranes.
const std::string kRelaxingCharges =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 0.8, 1.2]\n"
    "[membrane]\nbending_modulus = 0.2\ncapacitance = 0.8\nconductance = 0.5\n"
    "[electric]\nfield = [0.3, 0.1, 0.8]\nconductivity_in = 2.0\nconductivity_out = 1.0\npermittivity = 0.2\n"
    "displacement_current = true\ninitial_Vm = \"steady\"\n[electric.waveform]\nkind = \"pulse\"\nduration = 0.05\n"
    "[[vesicle]]\n[vesicle.shape]\ncentre = [-0.2, 0.1, 0.0]\n"
    "[[vesicle]]\n[vesicle.shape]\ncentre = [2.2, 0.5, 0.8]\nscale = 0.8\n[vesicle.membrane]\nbending_modulus = 0.1\n"
    "[vesicle.electric]\nconductivity_in = 0.4\npermittivity_ratio = 1.5\n"
    "[numerics]\norder = 4\ntime_order = 2\ndt = 0.05\nend_time = 0.1\n";

/// The same vesicles with pores that open.
const std::string kPores = kRelaxingCharges.substr(0, kRelaxingCharges.find("initial_Vm")) +
                           "[poration]\nmodel = \"pores\"\ncreation_rate = 0.5\ncreation_Vm = 0.1\nrest_density = "
                           "2.0\npore_radius = 0.1\nmembrane_thickness = 0.2\n" +
                           kRelaxingCharges.substr(kRelaxingCharges.find("[[vesicle]]"));

/// Enough vesicles for multipole expansions and for inverses of their own.
const std::string kSuspension =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 0.9, 1.2]\n[membrane]\nbending_modulus = 0.1\n"
    "[flow]\nkind = \"shear\"\nrate = 1.0\n[contact]\nenergy = 0.1\nrange = 0.5\n"
    "[electric]\nfield = [0.0, 0.0, 0.5]\nconductivity_in = 1.0\nconductivity_out = 2.0\ninitial_Vm = \"steady\"\n"
    "[numerics]\norder = 4\ndt = 0.1\nend_time = 0.1\n"
    "[suspension]\nkind = \"box\"\nsize = [12, 12, 30]\ncount = 10\n";

/// One run in a directory of its own, which each session begins or continues.
class Run {
 public:
  [[nodiscard]] std::string file(const std::string& name) const { return file_text(folder_ / ("out/" + name)); }
  /// Checksums of all numbers of each snapshot.
  [[nodiscard]] std::vector<std::int64_t> checksums() const {
    const vehd::RunReader run(folder_ / "out/run.h5");
    std::vector<std::int64_t> all;
    for (std::size_t count = 1; count <= run.times().size(); ++count) all.push_back(run.checksum(count));
    return all;
  }
  [[nodiscard]] std::string counted(const std::string& what) const {
    return nlohmann::json::parse(file("summary.json")).at(what).dump();
  }

  /// Final message of each rank.
  std::vector<std::string> go_on(const std::string& scene, int n_ranks) const {
    return on_ranks(n_ranks, [&](const Ranks& ranks) {
      return ranks.collective([&] {
        const vehd::SceneSource source{folder_ / "scene.toml", {}, scene};
        const vehd::RunSession session(vehd::read_scene(source), source, folder_ / "out", true, ranks);
        vehd::Interruption interruption;
        const vehd::RunOutcome outcome = vehd::simulate(session.task({}, vehd::longest_lag_of_files), interruption);
        if (outcome.completed && ranks.is_first()) (void)session.summarise(outcome);
        return outcome.completed ? std::string("completed") : outcome.reason;
      });
    });
  }

  [[nodiscard]] vehd::Scene scene(const std::string& text) const {
    return vehd::read_scene(vehd::SceneSource{folder_ / "scene.toml", {}, text});
  }

  void make_unwritable() const { std::filesystem::create_directories(folder_ / "out/run.h5"); }

 private:
  TemporaryDirectory folder_;
};

void check_completed(const std::vector<std::string>& said) {
  for (const std::string& of_rank : said) BOOST_TEST(of_rank == "completed");
}

/// Checks that runs of this scene on these numbers of ranks give the files and counts of a run on one rank.
void check_same_files(const std::string& scene, const std::vector<int>& numbers) {
  const Run alone;
  check_completed(alone.go_on(scene, 1));
  for (const int n_ranks : numbers) {
    const Run shared;
    check_completed(shared.go_on(scene, n_ranks));
    for (const char* name : {"history.csv", "vesicles.csv"}) BOOST_TEST((shared.file(name) == alone.file(name)), name);
    BOOST_TEST(shared.checksums() == alone.checksums(), boost::test_tools::per_element());
    for (const char* what : {"kernel_evaluations", "pair_targets"})
      BOOST_TEST(shared.counted(what) == alone.counted(what));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_of_first_order_have_the_same_bits_on_any_number_of_ranks) {
  check_same_files(three_vesicles("order = 4\ndt = 0.1\nend_time = 0.2\n"), {2, 3});
}

BOOST_AUTO_TEST_CASE(steps_with_a_tolerance_have_the_same_bits_on_any_number_of_ranks) {
  check_same_files(three_vesicles("order = 6\ntime_order = 2\ntolerance = 1e-1\nend_time = 0.1\n"), {2});
}

BOOST_AUTO_TEST_CASE(displacement_currents_have_the_same_bits_on_any_number_of_ranks) {
  check_same_files(kRelaxingCharges, {2});
}

BOOST_AUTO_TEST_CASE(pores_have_the_same_bits_on_any_number_of_ranks_and_go_on) {
  check_same_files(kPores, {2});
  const auto until = [](const std::string& end) {
    return kPores.substr(0, kPores.find("end_time")) + end + "[output]\nevery = 0.05\n";
  };
  const Run whole, resumed;
  check_completed(whole.go_on(until("end_time = 0.15\n"), 1));
  check_completed(resumed.go_on(until("end_time = 0.05\n"), 2));
  check_completed(resumed.go_on(until("end_time = 0.15\n"), 1));
  for (const char* name : {"history.csv", "vesicles.csv"}) BOOST_TEST((resumed.file(name) == whole.file(name)), name);
}

BOOST_AUTO_TEST_CASE(exchanged_vesicles_have_the_same_bits_on_any_number_of_ranks) {
  const Run planned;
  const vehd::Problem problem = vehd::problem_of(planned.scene(kTwoPairs));
  BOOST_TEST((problem.symmetry.exchange.originals() == std::vector<std::size_t>{0, 1, 0, 1}));
  check_same_files(kTwoPairs, {2, 3});
}

BOOST_AUTO_TEST_CASE(many_vesicles_have_the_same_bits_on_any_number_of_ranks) { check_same_files(kSuspension, {2, 3}); }

BOOST_AUTO_TEST_CASE(a_run_goes_on_with_another_number_of_ranks) {
  const auto until = [](const std::string& end) {
    return three_vesicles("order = 4\ndt = 0.1\nend_time = " + end + "\n");
  };
  const Run whole, resumed;
  check_completed(whole.go_on(until("0.3"), 1));
  check_completed(resumed.go_on(until("0.1"), 3));
  check_completed(resumed.go_on(until("0.2"), 1));
  check_completed(resumed.go_on(until("0.3"), 2));
  for (const char* name : {"history.csv", "vesicles.csv"}) BOOST_TEST((resumed.file(name) == whole.file(name)), name);
}

BOOST_AUTO_TEST_CASE(a_rank_without_a_directory_to_write_in_ends_all) {
  const Run run;
  run.make_unwritable();
  const std::vector<std::string> said = run.go_on(three_vesicles("order = 4\ndt = 0.1\nend_time = 0.1\n"), 3);
  for (const std::string& of_rank : said) {
    BOOST_TEST(of_rank == said.front());
    BOOST_TEST(of_rank != "completed");
  }
}

BOOST_AUTO_TEST_SUITE_END()
