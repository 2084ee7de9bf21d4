#include "bie/pictures/history_panels.hpp"

#include <boost/test/unit_test.hpp>
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
    for (const HistoryCurve& curve : panel.curves) {
      if (curve.label.starts_with(label)) return true;
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
  // No flow turns the shape.
  BOOST_TEST(!shows(panels(Scene(), start + "0,0,0\n"), "inclination"));
}

BOOST_AUTO_TEST_SUITE_END()
