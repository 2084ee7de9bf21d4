#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/bench/picture.hpp"

using namespace vehd;

namespace {

Box box_of_note(const PlacedNote& note, double font) {
  const double half_width = 0.5 * font * text_width(note.text), half_height = 0.5 * font;
  return {note.at[0] - half_width, note.at[1] - half_height, note.at[0] + half_width, note.at[1] + half_height};
}

/// Curves like those of bench time: they cross and overlap.
BenchPanel crowded() {
  BenchPanel panel{"seconds", "error"};
  for (int order = 1; order <= 4; ++order) {
    BenchCurve curve;
    curve.label = std::to_string(order);
    for (int i = 0; i < 5; ++i) {
      curve.x.push_back(0.1 * std::pow(2.0, i) * order);
      curve.y.push_back(order == 4 ? 5e-5 : 0.02 * std::pow(2.0, -order * i));
      curve.notes.push_back(std::to_string(0.5 * std::pow(0.5, i)));
    }
    curve.colour = order;
    panel.curves.push_back(curve);
  }
  return panel;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(plot_axes)

BOOST_AUTO_TEST_CASE(notes_meet_neither_each_other_nor_points_nor_the_frame) {
  constexpr double font = 6.5;
  BenchPanel panel = crowded();
  panel.slopes = {slope_beside(panel.curves[0], -1.0, "N^{-1}", 0.5),
                  slope_beside(panel.curves[1], -2.0, "N^{-2}", 0.5)};
  const PlotAxes axes = axes_of(panel, 186.0, 165.0);
  const std::vector<PlacedNote> notes = place_notes(panel, axes, font);
  // Most notes have been placed.
  BOOST_TEST(notes.size() >= 12);
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const Box box = box_of_note(notes[i], font);
    BOOST_TEST((Box{0.0, 0.0, 186.0, 165.0}.holds(box)), notes[i].text);
    for (std::size_t k = 0; k < i; ++k) {
      BOOST_TEST(!box.meets(box_of_note(notes[k], font)), notes[i].text + " over " + notes[k].text);
    }
    for (const BenchCurve& curve : panel.curves) {
      for (std::size_t k = 0; k < curve.x.size(); ++k) {
        const double x = axes.x.place(curve.x[k]), y = axes.y.place(curve.y[k]);
        BOOST_TEST(!box.meets({x - 2.0, y - 2.0, x + 2.0, y + 2.0}), notes[i].text);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(axes_hold_every_point_and_slope) {
  BenchPanel panel = crowded();
  panel.slopes = {slope_beside(panel.curves[3], -4.0, "N^{-4}", 0.5)};
  const PlotAxes axes = axes_of(panel, 186.0, 165.0);
  for (const BenchCurve& curve : panel.curves) {
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      BOOST_TEST(axes.x.place(curve.x[i]) > 0.0);
      BOOST_TEST(axes.x.place(curve.x[i]) < 186.0);
      BOOST_TEST(axes.y.place(curve.y[i]) > 0.0);
      BOOST_TEST(axes.y.place(curve.y[i]) <= 165.0);
    }
  }
  const BenchSlope& slope = panel.slopes[0];
  BOOST_TEST(axes.y.place(slope.y_from) <= 165.0);
  const double ratio = slope.y_from / (0.5 * panel.curves[3].y.back());
  BOOST_TEST(std::log(ratio) / std::log(slope.x_to / slope.x_from) == 4.0, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
