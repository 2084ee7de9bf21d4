#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "bie/physics/point_sources.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

const ElectricParameters kElectric{Vector3::Zero(), 2.0, 1.0, 1.0};

/// Rows x,y,z,strength,side of tests/data/example1_sources.csv.
std::vector<PointSource> read_sources() {
  std::ifstream file("tests/data/example1_sources.csv");
  std::vector<PointSource> sources;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'x') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    PointSource source{};
    std::string side;
    row >> source.position.x() >> source.position.y() >> source.position.z() >> source.strength >> side;
    source.inside = side == "inside";
    sources.push_back(source);
  }
  return sources;
}

struct Target {
  int order;
  double charge, force;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(example1)

BOOST_AUTO_TEST_CASE(errors_and_iterations_reach_the_published_figures) {
  const std::vector<PointSource> sources = read_sources();
  BOOST_REQUIRE(sources.size() == 6u);
  for (const Target& target : {Target{12, 1.7e-3, 7e-3}, {16, 3.0e-4, 7e-4}, {24, 1.5e-5, 4e-5}, {32, 8e-7, 1.3e-6}}) {
    // Products are formed on the grid of order p, as in the figures of the paper.
    const Space space(target.order, 1);
    const Membrane membrane = make_membrane(space, shape_33(target.order), kLaplaceLayers);
    const PointSourceErrors errors = point_source_errors(kElectric, sources, membrane, 1e-10);
    BOOST_TEST_CONTEXT("order " << target.order) {
      BOOST_TEST(errors.charge <= target.charge);
      BOOST_TEST(errors.force <= target.force);
      BOOST_TEST(errors.report.converged());
      BOOST_TEST(errors.report.iterations <= 9);
    }
  }
}

BOOST_AUTO_TEST_CASE(sources_obey_the_jump_conditions_on_the_sphere) {
  // One source at the centre: φ_e = s/(4πr) and φ_i = 0.
  const Space space(8);
  const Surface surface = make_surface(space.fine, sphere(8, 2.0));
  const PointSourceFields fields = point_source_fields({{Vector3::Zero(), 3.0, true}}, surface);
  const double pi = std::numbers::pi;
  BOOST_TEST(max_difference(fields.potential_out, Vector::Constant(surface.n_points(), 3.0 / (8.0 * pi))) < 1e-13);
  BOOST_TEST(max_difference(fields.flux_out, Vector::Constant(surface.n_points(), -3.0 / (16.0 * pi))) < 1e-13);
  BOOST_TEST(fields.potential_in.isZero(0.0));
  BOOST_TEST(fields.flux_in.isZero(0.0));
}

BOOST_AUTO_TEST_SUITE_END()
