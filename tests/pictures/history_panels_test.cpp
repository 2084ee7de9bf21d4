#include "bie/pictures/history_panels.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <sstream>

using namespace vehd;

namespace {

const std::string header =
    "time,dt,bending_energy_scaled,tension_integral,Vm_north,q_north,extent_x,extent_y,extent_z,inclination_deg,"
    "area_drift,volume_drift,strain_max\n";

std::vector<HistoryPanel> panels(const Scene& scene, const std::string& rows) {
  std::istringstream stream(header + rows);
  return panels_of(scene, HistoryTable(stream, "history.csv"));
}

bool shows(const std::vector<HistoryPanel>& all, const std::string& label) {
  for (const HistoryPanel& panel : all) {
    for (const HistoryQuantity& axis : panel.axes) {
      for (const HistoryCurve& curve : axis.curves) {
        if (curve.label.starts_with(label)) return true;
      }
    }
  }
  return false;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(history_panels)

BOOST_AUTO_TEST_CASE(columns_without_numbers_are_left_out) {
  Scene scene;
  scene.electric.emplace();
  scene.flow.emplace();
  const auto drawn = panels(scene,
                            "0,0,15,nan,nan,nan,2,2,4,0,0,0,0\n"
                            "1,1,14,nan,nan,nan,2,2,3,5,1e-12,0,1e-9\n");
  BOOST_TEST(shows(drawn, "bending energy"));
  BOOST_TEST(shows(drawn, "inclination"));
  BOOST_TEST(!shows(drawn, "tension"));
  BOOST_TEST(!shows(drawn, "V_m"));
  BOOST_TEST(!shows(drawn, "area"));
  BOOST_TEST(panels(scene, "").empty());
  BOOST_TEST(panels(scene, "0,0,15,nan,nan,nan,2,2,4,0,0,0,0\n").empty());
}

BOOST_AUTO_TEST_CASE(drifts_are_shown_where_they_matter) {
  const std::string start =
      "0,0,15,1,nan,nan,2,2,4,90,0,0,0\n1,1,14,1,nan,nan,2,2,3,90,1e-9,1e-9,1e-9\n2,1,14,1,nan,nan,2,2,3,90,";
  BOOST_TEST(!shows(panels(Scene(), start + "1e-9,1e-9,1e-4\n"), "area"));
  BOOST_TEST(shows(panels(Scene(), start + "-2e-6,1e-9,1e-4\n"), "area"));
  BOOST_TEST(shows(panels(Scene(), start + "1e-9,1e-9,0.02\n"), "local strain"));
  // There is no flow that could turn the shape.
  BOOST_TEST(!shows(panels(Scene(), start + "0,0,0\n"), "inclination"));
}

BOOST_AUTO_TEST_CASE(a_report_contains_all_that_a_picture_does) {
  Scene scene;
  scene.electric.emplace();
  scene.numerics.tolerance = 1e-3;
  std::istringstream stream(
      "time [ms],dt [ms],bending_energy_scaled,Vm_north [mV],Vm_max [mV],extent_x [um],extent_y [um],extent_z [um],"
      "aspect_ratio,area_drift,order\n"
      "0,0,15,0,0,2,4,3,2,1e-9,8\n1,1,14,5,6,2,3,3,1.5,-2e-6,9\n2,1,14,5,6,2,3,3,1.5,0,9\n");
  const HistoryTable history(stream, "history.csv");
  const auto quantities = history_quantities(scene, history);
  std::vector<std::string> labels;
  for (const HistoryQuantity& quantity : quantities) labels.push_back(quantity.label);
  BOOST_TEST(labels == (std::vector<std::string>{"bending energy", "potential across the membrane", "aspect ratio",
                                                 "errors", "extent", "step", "degree"}),
             boost::test_tools::per_element());
  BOOST_TEST(quantities[1].unit == "mV");
  BOOST_TEST(quantities[1].curves.size() == 2);
  BOOST_TEST(quantities[2].curves.front().label == "aspect ratio");
  BOOST_TEST(quantities[2].curves.front().values == (std::vector<double>{2.0, 1.5, 1.5}),
             boost::test_tools::per_element());
  BOOST_TEST(quantities[3].is_logarithmic);
  BOOST_TEST(std::isnan(quantities[3].curves.front().values[2]));
  BOOST_TEST(quantities[3].curves.front().values[1] == 2e-6);
  BOOST_TEST(quantities[4].unit == "um");
  for (const HistoryPanel& panel : panels_of(scene, history)) {
    for (const HistoryQuantity& axis : panel.axes) {
      BOOST_TEST((std::ranges::find(labels, axis.label) != labels.end()), axis.label);
    }
  }
}

BOOST_AUTO_TEST_CASE(aspect_ratio_is_that_along_the_field_where_there_is_one) {
  const auto label_of = [](const std::string& ratios) {
    std::istringstream stream("time,aspect_ratio,aspect_ratio_field,centroid_z\n" + ratios);
    const auto quantities = history_quantities(Scene(), HistoryTable(stream, "history.csv"));
    const auto aspect = std::ranges::find(quantities, "aspect ratio", &HistoryQuantity::label);
    return aspect == quantities.end() || aspect->curves.size() != 1 ? "" : aspect->curves.front().label;
  };
  BOOST_TEST(label_of("0,1.2,0.8,0\n1,1.1,1.1,1\n") == "aspect ratio along the field");
  for (const std::string none : {"0", "nan"}) {
    BOOST_TEST(label_of("0,1.2," + none + ",0\n1,1.1," + none + ",1\n") == "aspect ratio");
  }
}

BOOST_AUTO_TEST_CASE(an_oscillation_has_the_envelope_of_its_extremes) {
  HistoryCurve wave{"wave", {}};
  for (int i = 0; i < 4000; ++i) wave.values.push_back(3.0 + std::sin(0.4 * i));
  const HistoryCurve envelope = envelope_of_oscillation(wave);
  BOOST_TEST(envelope.is_envelope);
  BOOST_TEST_REQUIRE(envelope.errors.size() == wave.values.size());
  for (std::size_t i = 0; i < wave.values.size(); i += 50) {
    BOOST_TEST(std::abs(envelope.values[i] - 3.0) < 0.03);
    BOOST_TEST(std::abs(envelope.errors[i] - 1.0) < 0.03);
  }
  wave.values.resize(100);
  BOOST_TEST(envelope_of_oscillation(wave).errors.empty());
  HistoryCurve settled{"settled", {}};
  for (int i = 0; i < 4000; ++i) settled.values.push_back(std::exp(-i / 10.0) + 1e-12 * std::sin(i));
  BOOST_TEST(envelope_of_oscillation(settled).errors.empty());
}

BOOST_AUTO_TEST_CASE(time_is_logarithmic_where_all_changes_are_at_the_start) {
  std::vector<double> times;
  HistoryPanel early{{HistoryQuantity{"early", "", {{"early", {}}}}}},
      late{{HistoryQuantity{"late", "", {{"late", {}}}}}};
  for (int i = 0; i <= 1000; ++i) {
    times.push_back(i);
    early.axes.front().curves.front().values.push_back(std::exp(-i / 10.0));
    late.axes.front().curves.front().values.push_back(std::exp(-i / 300.0));
  }
  BOOST_TEST(changes_at_the_start(std::vector{early}, times));
  BOOST_TEST(!changes_at_the_start(std::vector{early, late}, times));
}

BOOST_AUTO_TEST_CASE(the_centroid_is_shown_of_vesicles_that_settle_or_swim) {
  const std::string rows = "time,aspect_ratio,centroid_z\n0,1.2,0\n1,1.1,1\n";
  const auto has_centroid = [&](const Scene& scene) {
    std::istringstream stream(rows);
    return shows(panels_of(scene, HistoryTable(stream, "history.csv")), "along z");
  };
  Scene swimmer;
  swimmer.membrane.pump.emplace();
  BOOST_TEST(has_centroid(swimmer));
  BOOST_TEST(!has_centroid(Scene()));
}

BOOST_AUTO_TEST_CASE(rows_within_a_step_show_its_size) {
  Scene scene;
  scene.numerics.tolerance = 1e-3;
  const auto drawn = [&] {
    std::istringstream stream(header +
                              "0,0,15,1,nan,nan,2,2,4,90,0,0,0\n1,0,14,1,nan,nan,2,2,3,90,0,0,0\n"
                              "2,2,14,1,nan,nan,2,2,3,90,0,0,0\n3,1,14,1,nan,nan,2,2,3,90,0,0,0\n");
    return history_quantities(scene, HistoryTable(stream, "history.csv"));
  }();
  const auto step = std::ranges::find(drawn, "step", &HistoryQuantity::label);
  BOOST_TEST_REQUIRE((step != drawn.end()));
  BOOST_TEST(step->curves.front().values == (std::vector<double>{2.0, 2.0, 2.0, 1.0}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(thinned_curves_keep_their_peaks_and_ends) {
  std::vector<HistoryCurve> curves = {{"low", std::vector<double>(10007, 1.0)},
                                      {"high", std::vector<double>(10007, 1.0)}};
  const double none = std::numeric_limits<double>::quiet_NaN();
  curves[0].values[4321] = -7.0;
  curves[0].values[4322] = none;
  curves[1].values[5] = 9.0;
  curves[1].values[0] = none;
  const std::vector<std::size_t> rows = rows_to_draw(curves, 100);
  for (const std::size_t row : {0, 5, 4321, 10006}) {
    BOOST_TEST((std::ranges::find(rows, row) != rows.end()), row);
  }
  BOOST_TEST(std::ranges::is_sorted(rows));
  BOOST_TEST(rows.size() < 500);
  const std::vector<HistoryCurve> few = {{"few", {1.0, 2.0, 3.0}}};
  BOOST_TEST(rows_to_draw(few, 100).size() == 3);
}

BOOST_AUTO_TEST_CASE(curves_have_the_errors_of_their_columns) {
  const auto table = [](const std::string& rows) {
    std::istringstream stream(header + rows);
    return HistoryTable(stream, "history.csv");
  };
  const HistoryTable history = table("0,0,15,1,nan,nan,2,2,4,0,0,0,0\n1,1,14,1,nan,nan,2,2,3,5,1e-12,0,1e-9\n");
  // The error history of an interrupted run ends earlier.
  const HistoryTable errors = table("0,0,0.5,0,nan,nan,0.1,0.2,0.3,0,0,0,0\n");
  const auto quantities = history_quantities(Scene(), history, &errors);
  const auto extents = std::ranges::find(quantities, "extent", &HistoryQuantity::label);
  BOOST_TEST_REQUIRE((extents != quantities.end()));
  const HistoryCurve& along_y = extents->curves.at(1);
  BOOST_TEST_REQUIRE(along_y.errors.size() == 2U);
  BOOST_TEST(along_y.errors[0] == 0.2);
  BOOST_TEST(std::isnan(along_y.errors[1]));
  BOOST_TEST(history_quantities(Scene(), history).front().curves.front().errors.empty());
}

BOOST_AUTO_TEST_SUITE_END()
