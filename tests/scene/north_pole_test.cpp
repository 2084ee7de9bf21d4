#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/fields.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(north_pole)

namespace {

constexpr int kLowest = 4, kHighest = 64;

struct NamedShape {
  const char* text;
  bool axisymmetric;  ///< about z; computed on four longitudes, as in a run
};

/// One shape of every kind.
const std::vector<NamedShape> kShapes{
    {"kind = 'ellipsoid'\naxes = [1, 1, 1]", true},
    {"kind = 'ellipsoid'\naxes = [1.1, 0.8, 1.7]", false},
    {"kind = 'prolate'\nreduced_volume = 0.7", true},
    {"kind = 'oblate'\nreduced_volume = 0.6", true},
    {"kind = 'biconcave'\nreduced_volume = 0.6", true},
    {"kind = 'stomatocyte'\nreduced_volume = 0.5", true},
    {"kind = 'radial'\nbase = 1\namplitude = 0.2\nexponent = -3\nmodes = [{n=3, m=2, a=1}]", false},
    {"kind = 'radial'\nbase = 1\nmodes = [{n=4, m=-3, a=0.3}, {n=3, m=1, a=0.2}, {n=2, m=1, a=0.2}]", false},
    {"kind = 'prolate'\nreduced_volume = 0.9\nrotation = [0, 1, 0, 60]", false},
    {"kind = 'biconcave'\nreduced_volume = 0.65\nrotation = [1, 2, 0.5, 70]", false},
    {"kind = 'oblate'\nreduced_volume = 0.8\ncentre = [0.3, -20, 5]", false},
    {"kind = 'stomatocyte'\nreduced_volume = 0.6\nrotation = [1, 0, 0, 180]", false},
    {"kind = 'stomatocyte'\nreduced_volume = 0.6\nrotation = [1, 0, 0, 25]\ncentre = [1, 2, 3]", false}};

Matrix position_of(const NamedShape& shape, int order) {
  return initial_position(
      parsed("[shape]\n" + std::string(shape.text) + "\n[numerics]\ndt=1\nend_time=1\norder=" + std::to_string(order)));
}

struct Reading {
  double height = 0.0;  ///< of the point at which the history reads V_m: its value for V_m = z
  Vector3 centroid;
};

Reading reading_of(const SphereTransform& fine, const Matrix& position) {
  State state;
  state.vesicles.emplace_back();
  state.vesicles[0].position = position;
  state.vesicles[0].transmembrane_potential = position.col(2);
  VesicleFields fields;
  fields.charge = Vector::Zero(position.rows());
  const Surface surface = make_surface(fine, position);
  return {along_lab_frame_axes({}, {}, fine, surface, state.vesicles[0], fields).Vm_north, centroid(surface)};
}

SphereTransform transform_of(int order, bool axisymmetric) {
  return axisymmetric ? SphereTransform(order, make_grid(2 * order, 4), 1)
                      : SphereTransform(order, make_grid(2 * order));
}

}  // namespace

BOOST_AUTO_TEST_CASE(place_is_the_same_on_every_shape_at_every_order_up_to_truncation) {
  const GridAngles points = grid_angles(make_grid(8));
  const SphereTransform finest = transform_of(kHighest, false);
  std::vector<Matrix> exact;
  std::vector<Reading> expected;
  for (const NamedShape& shape : kShapes) {
    const Matrix position = position_of(shape, kHighest);
    exact.push_back(evaluate_harmonics(position, points.theta, points.phi));
    expected.push_back(reading_of(finest, position));
  }
  for (int order = kLowest; order < kHighest; ++order) {
    const SphereTransform all_longitudes = transform_of(order, false), four_longitudes = transform_of(order, true);
    for (std::size_t i = 0; i < kShapes.size(); ++i) {
      const NamedShape& shape = kShapes[i];
      const Matrix position = position_of(shape, order);
      const Reading reading = reading_of(shape.axisymmetric ? four_longitudes : all_longitudes, position);
      const Matrix left_out = exact[i] - evaluate_harmonics(position, points.theta, points.phi);
      const double error = left_out.rowwise().norm().maxCoeff() + (reading.centroid - expected[i].centroid).norm();
      // Where the surface slopes, the height changes more than the line or the surface.
      const double bound = 4.0 * error + 1e-12 * exact[i].rowwise().norm().maxCoeff();
      BOOST_TEST(std::abs(reading.height - expected[i].height) <= bound,
                 shape.text << "\nat order " << order << ": " << reading.height << " for " << expected[i].height
                            << " to " << bound);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
