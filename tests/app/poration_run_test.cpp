#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/files/hdf5_reader.hpp"
#include "bie/runs/history.hpp"
#include "tests/app/reference_run.hpp"

namespace {

const std::string porating_sphere =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.2]\ncentre = [0.5, 0, 0]\n[membrane]\nbending_modulus = 0.1\n"
    "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 0.5\n";
const std::string porating_steps = "[numerics]\norder = 6\ndt = 0.1\nend_time = 1\n[output]\nevery = 0.2\n";
const std::string first_crossing = "[poration]\nmodel = \"criterion\"\nthreshold_Vm = 0.4\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(poration_run, *boost::unit_test::label("slow") * boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(a_crossing_is_reported_and_resumes_bit_for_bit) {
  const RunPair pair(porating_sphere + first_crossing + porating_steps);
  pair.run_reference();
  // Stops after the crossing; the run below stops before it.
  pair.run_until("0.8");
  pair.finish();
  const RunPair before(porating_sphere + first_crossing + porating_steps);
  before.run_reference();
  before.run_until("0.4");
  before.finish();
  const vehd::HistoryTable history(pair.output + "/history.csv");
  const auto& times = history.column("poration_time");
  BOOST_TEST(std::isinf(times.front()));
  BOOST_TEST((times.back() > 0.2 && times.back() < 0.8), times.back());
  const auto poration = json_of(pair.output + "/summary.json").at("poration");
  BOOST_TEST(poration.at("time").get<double>() == times.back());
  BOOST_TEST(std::abs(poration.at("place")[0].get<double>() - 0.5) < 1e-6);
  BOOST_TEST(std::abs(poration.at("place")[2].get<double>()) > 1.1);
}

BOOST_AUTO_TEST_CASE(a_criterion_adds_columns_and_changes_no_bit_of_the_others) {
  const FinishedRun with(porating_sphere + first_crossing + porating_steps), without(porating_sphere + porating_steps);
  const vehd::HistoryTable one(with.output + "/history.csv"), other(without.output + "/history.csv");
  BOOST_TEST(one.names().size() == other.names().size() + 5);
  for (const std::string& name : other.names()) BOOST_TEST((one.column(name) == other.column(name)), name);
  BOOST_TEST(!other.has("poration_load"));
}

BOOST_AUTO_TEST_CASE(pores_go_on_bit_for_bit_and_have_fields_and_pictures) {
  const RunPair pair(porating_sphere +
                     "[poration]\nmodel = \"pores\"\ncreation_rate = 0.1\ncreation_Vm = 0.25\nrest_density = 2\n"
                     "pore_radius = 0.1\nmembrane_thickness = 0.2\n" +
                     porating_steps);
  pair.run_reference();
  pair.run_until("0.4");
  pair.finish();
  const vehd::Hdf5Reader file(pair.output + "/run.h5");
  const vehd::HistoryTable history(pair.output + "/history.csv");
  const double most = file.vector("/snapshots/000005/poration").maxCoeff();
  BOOST_TEST((most > 1.0 && 2.0 * std::exp(most) <= history.column("pore_density_max").back()), most);
  BOOST_TEST(history.column("conductance_max").back() > history.column("conductance_max").front());
  BOOST_TEST(file.has("/snapshots/000002/surface/conductance"));
  BOOST_TEST(!history.has("poration_load"));
  const ProgramResult finer = run_vehd({"run", pair.scene, "-o", pair.output, "--resume", "--no-plot", "--set",
                                        "numerics.end_time=1.2", "--set", "numerics.degree=8"});
  BOOST_TEST(finer.exit_code == 0, finer.errors);
  for (const char* field : {"poration", "conductance"}) {
    const ProgramResult result = run_vehd({"plot", pair.output, "--field", field, "-o", pair.directory / "shapes.svg"});
    BOOST_TEST(result.exit_code == 0, result.errors);
  }
}

BOOST_AUTO_TEST_SUITE_END()
