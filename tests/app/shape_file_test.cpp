#include <boost/test/unit_test.hpp>

#include "bie/scene/initial_shape.hpp"
#include "bie/scene/reader.hpp"
#include "bie/sphere/harmonics.hpp"
#include "tests/app/program.hpp"

namespace {

/// Position at `order` of a scene whose [shape] says this; "run" in it is where a run of the scene below lies.
struct StoredShape {
  TemporaryDirectory directory;

  StoredShape() {
    write_text(directory / "scene.toml",
               "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.5, 2.0]\n"
               "[numerics]\norder = 6\ndt = 0.1\nend_time = 0\n");
    const ProgramResult result = run_vehd({"run", directory / "scene.toml", "-o", directory / "run", "--no-plot"});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  }

  [[nodiscard]] vehd::Matrix position(const std::string& shape, int order) const {
    const std::string text =
        "[shape]\n" + shape + "\n[numerics]\ndt=1\nend_time=1\norder=" + std::to_string(order) + "\n";
    return vehd::initial_position(vehd::parse_scene(text, "scene.toml", directory / ""));
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(shape_file)

BOOST_FIXTURE_TEST_CASE(a_snapshot_is_taken_over_at_any_order, StoredShape) {
  for (const int order : {4, 6, 12}) {
    const vehd::Matrix stored = position("kind='file'\npath='run/run.h5'", order);
    const vehd::Matrix expected = position("kind='ellipsoid'\naxes=[1,1.5,2]", order);
    BOOST_TEST(stored.rows() == vehd::n_coefficients(order));
    BOOST_TEST((stored - expected).cwiseAbs().maxCoeff() < 1e-12);
  }
}

BOOST_FIXTURE_TEST_CASE(a_snapshot_can_be_scaled_rotated_and_moved, StoredShape) {
  const std::string place = "\nscale=1.5\nrotation=[1,1,0,25]\ncentre=[0,0,1]";
  const vehd::Matrix stored = position("kind='file'\npath='run/run.h5'" + place, 8);
  const vehd::Matrix expected = position("kind='ellipsoid'\naxes=[1,1.5,2]" + place, 8);
  BOOST_TEST((stored - expected).cwiseAbs().maxCoeff() < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
