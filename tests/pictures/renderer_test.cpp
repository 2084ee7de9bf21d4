#include "bie/pictures/renderer.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/pictures/view.hpp"
#include "bie/sphere/surface_mesh.hpp"

using namespace vehd;

namespace {

/// A sphere of radius 2.
RenderMesh sphere_mesh() {
  const SphereGrid grid = make_grid(31);
  RenderMesh mesh;
  mesh.points.resize(grid.n_points() + 2, 3);
  for (int j = 0; j < grid.n_theta; ++j) {
    for (int k = 0; k < grid.n_phi; ++k) {
      mesh.points.row(Index{j} * grid.n_phi + k) << std::sin(grid.theta[j]) * std::cos(grid.phi[k]),
          std::sin(grid.theta[j]) * std::sin(grid.phi[k]), std::cos(grid.theta[j]);
    }
  }
  mesh.points.bottomRows(2) << 0.0, 0.0, 1.0, 0.0, 0.0, -1.0;
  mesh.normals = mesh.points;
  mesh.points *= 2.0;
  mesh.shade = Vector::Constant(mesh.points.rows(), 1.0);
  mesh.triangles = closed_triangles(grid);
  return mesh;
}

/// Number of pixels that are not background.
int covered(const Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    count += image.rgb[i] != 255 || image.rgb[i + 1] != 255 || image.rgb[i + 2] != 255 ? 1 : 0;
  }
  return count;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(renderer)

BOOST_AUTO_TEST_CASE(a_sphere_is_a_disc_of_its_radius_from_everywhere) {
  const RenderMesh mesh = sphere_mesh();
  for (const char* view : {"x", "y", "z", "1,2,3"}) {
    BOOST_TEST(projected_extent(mesh, parse_view(view)).x() == 2.0, boost::test_tools::tolerance(5e-3));
    const Image image = render(mesh, ColourMap::sequential(), {parse_view(view), 20.0, 100, 100});
    BOOST_TEST(covered(image) == M_PI * 40.0 * 40.0, boost::test_tools::tolerance(0.05));
  }
}

BOOST_AUTO_TEST_CASE(a_cut_shows_the_inside_and_its_edge_is_a_circle) {
  const RenderMesh mesh = sphere_mesh();
  const Matrix3 view = parse_view("y");
  const Image whole = render(mesh, ColourMap::diverging(), {view, 20.0, 100, 100});
  const Image cut = render(mesh, ColourMap::diverging(), {view, 20.0, 100, 100, true});
  BOOST_TEST(covered(cut) == covered(whole), boost::test_tools::tolerance(0.02));
  // The inside is paler than the dark red outside.
  const std::size_t middle = (50 * 100 + 50) * 3;
  BOOST_TEST(int{cut.rgb[middle + 1]} > int{whole.rgb[middle + 1]} + 30);
  const Matrix lines = cut_lines(mesh, view);
  BOOST_TEST(lines.rows() >= 64);
  double length = 0.0;
  for (Index i = 0; i < lines.rows(); ++i) {
    BOOST_TEST(lines.row(i).head(2).norm() == 2.0, boost::test_tools::tolerance(5e-3));
    length += (lines.row(i).head(2) - lines.row(i).tail(2)).norm();
  }
  BOOST_TEST(length == 4.0 * M_PI, boost::test_tools::tolerance(5e-3));
}

BOOST_AUTO_TEST_SUITE_END()
