#include "bie/bench/panels.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/bench/result.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"

using namespace vehd;

namespace {

struct Tables {
  TemporaryDirectory directory;

  [[nodiscard]] std::vector<BenchPanel> panels(const std::string& name, const std::string& text) const {
    write_text(directory / (name + ".csv"), text);
    return panels_of(name, BenchRecord(directory / (name + ".csv")));
  }
};

const std::string time_table =
    "integrator,setting,seconds,steps,error,error_in_time\n"
    "order 1,0.5,0.1,40,2e-2,2e-2\norder 1,0.25,0.2,80,1e-2,1e-2\n"
    "order 4,0.5,1,40,5e-5,1e-6\norder 4,0.25,2,80,5e-5,6e-8\ntolerance,1e-2,0.1,10,1e-3,\ntolerance,1e-3,0.3,20,,\n";

}  // namespace

BOOST_AUTO_TEST_SUITE(panels)

BOOST_FIXTURE_TEST_CASE(errors_of_an_order_are_shown_apart_from_the_degree, Tables) {
  const auto drawn = panels("time", time_table);
  BOOST_REQUIRE(drawn.size() == 2);
  BOOST_TEST(drawn[0].curves.size() == 3u);
  // Runs with a tolerance have no fixed step, so they have no error of an order.
  BOOST_REQUIRE(drawn[1].curves.size() == 2);
  BOOST_TEST(drawn[1].curves[1].y[1] == 6e-8);
  BOOST_TEST(drawn[1].x_ticks == (std::vector<double>{40.0, 80.0}), boost::test_tools::per_element());
  BOOST_REQUIRE(drawn[1].slopes.size() == 2);
  BOOST_TEST(drawn[1].slopes[0].exponent == -1.0);
  BOOST_TEST(drawn[1].slopes[1].exponent == -4.0);
}

BOOST_FIXTURE_TEST_CASE(further_tables_have_pictures_where_they_are_curves, Tables) {
  BOOST_TEST(panels("time_digits", "integrator,error_largest,seconds_of_a_digit\norder 1,1e-2,10\n").empty());
  const auto drawn = panels("methods_from_shape",
                            "method,label,degree,unknowns,seconds,error_velocity,error_tension\n"
                            "bie,BIE,8,162,0.1,2e-2,1e-2\nbie,BIE,12,338,0.3,4e-3,2e-3\n"
                            "fem_degree,FEM,3,20000,1,5e-2,3e-2\nfem_degree,FEM,4,40000,2,1e-2,8e-3\n");
  BOOST_REQUIRE(drawn.size() == 2);
  BOOST_REQUIRE(drawn[0].curves.size() == 4);
  BOOST_TEST(drawn[0].curves[0].label == "BIE: v");
  BOOST_TEST(drawn[0].curves[3].y[1] == 8e-3);
  BOOST_TEST(drawn[1].curves[2].x[0] == 20000.0);
}

BOOST_FIXTURE_TEST_CASE(the_whole_step_lies_below_its_parts, Tables) {
  const auto drawn =
      panels("parts",
             "order,seconds_step,seconds_step_min,seconds_operator_assembly,seconds_operator_assembly_min,"
             "bytes_step,bytes_operator_assembly\n8,2,1,1,1,100,99\n16,20,10,10,10,1600,1590\n");
  BOOST_REQUIRE(drawn.size() == 2);
  for (const BenchPanel& panel : drawn) {
    BOOST_REQUIRE(panel.curves.size() == 2);
    BOOST_TEST((panel.curves[0].kind == CurveKind::wide));
    BOOST_TEST(panel.curves[1].label == "operator assembly");
    BOOST_TEST(!panel.slopes.empty());
  }
  // Each line has its label at its end.
  const auto end = [](const BenchSlope& line) {
    return line.y_from * std::pow(line.x_to / line.x_from, line.exponent);
  };
  BOOST_TEST(end(drawn[0].slopes[1]) > 2.0 * end(drawn[0].slopes[0]));
}

BOOST_FIXTURE_TEST_CASE(threads_are_bars, Tables) {
  const auto drawn =
      panels("threads", "part,threads,seconds,speed_up\nstep,1,2,1\nstep,2,1,2\nremap,1,0.5,1\nremap,2,0.4,1.25\n");
  BOOST_REQUIRE(drawn.size() == 1);
  BOOST_TEST(drawn[0].bars.groups == (std::vector<std::string>{"step", "remap"}));
  BOOST_TEST(drawn[0].bars.bars == (std::vector<std::string>{"1 thread", "2 threads"}));
  BOOST_TEST(drawn[0].bars.notes == (std::vector<std::string>{"× 2.00", "× 1.25"}));
}

BOOST_FIXTURE_TEST_CASE(names_of_methods_may_have_commas, Tables) {
  const auto drawn = panels("methods",
                            "method,label,unknowns,seconds,error_q,error_force\n"
                            "fem_mesh,\"FEM, mesh refined, k = 2\",1000,1,1e-2,2e-2\n"
                            "fem_mesh,\"FEM, mesh refined, k = 2\",9000,9,1e-3,2e-3\n");
  BOOST_REQUIRE(drawn.size() == 2);
  BOOST_TEST(drawn[1].curves.front().label == "FEM, mesh refined, k = 2: q");
  BOOST_TEST(drawn[1].slopes.front().exponent == -0.75);
}

BOOST_FIXTURE_TEST_CASE(pictures_are_drawn_again_from_tables_alone, Tables) {
  write_text(directory / "time.csv", time_table);
  write_text(directory / "scenes.csv", "scene\na\n");
  const auto pictures = redraw(directory / "", {});
  BOOST_REQUIRE(pictures.size() == 1);
  BOOST_TEST(file_text(pictures[0]).substr(1, 3) == "PNG");
  const TemporaryDirectory empty;
  BOOST_CHECK_THROW(redraw(empty / "", {}), InputError);
  write_text(directory / "time.csv", "integrator,setting\norder 1\n");
  BOOST_CHECK_THROW(redraw(directory / "", {}), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
