#include "meshes/msh_file.hpp"

#include <gmsh.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>

#include "meshes/gmsh_session.hpp"
#include "meshes/second_order_mesh.hpp"
#include "tests/meshes/shapes.hpp"
#include "tests/support/files.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

namespace {

/// Contents of a file as read back by gmsh.
struct ReadBack {
  std::size_t n_nodes = 0;
  std::array<std::size_t, 2> n_elements{};
  std::array<std::string, 2> names;
  std::array<double, 2> volume{};
  double smallest_determinant = 1e300;
  std::size_t n_views = 0;
  std::array<std::string, 2> membranes;
  std::array<double, 2> area{}, enclosed{};  ///< ∫dA and ∫x·n dA/3 of each group of faces
};

/// Sums over the faces of both physical groups of the membrane.
void read_membranes(int element_type, ReadBack& result) {
  std::vector<double> points, weights;
  gmsh::model::mesh::getIntegrationPoints(element_type, "Gauss8", points, weights);
  for (int side = 0; side < 2; ++side) {
    gmsh::model::getPhysicalName(2, side + 1, result.membranes[side]);
    std::vector<double> jacobians, determinants, positions;
    gmsh::model::mesh::getJacobians(element_type, points, jacobians, determinants, positions, side + 1);
    for (std::size_t i = 0; i < determinants.size(); ++i) {
      // The columns of the Jacobian are the two tangents and gmsh's unit normal; storage is by columns.
      const Point first(&jacobians[9 * i]), second(&jacobians[9 * i + 3]), x(&positions[3 * i]);
      const double weight = weights[i % weights.size()];
      result.area[side] += weight * first.cross(second).norm();
      result.enclosed[side] += weight * first.cross(second).dot(x) / 3.0;
    }
  }
}

ReadBack read_back(const std::filesystem::path& file, int element_type, int face_type) {
  const GmshSession session;
  gmsh::open(file.string());
  ReadBack result;
  std::vector<std::size_t> tags;
  std::vector<double> x;
  std::vector<double> unused;
  gmsh::model::mesh::getNodes(tags, x, unused);
  result.n_nodes = tags.size();
  std::vector<double> points;
  std::vector<double> weights;
  gmsh::model::mesh::getIntegrationPoints(element_type, "Gauss6", points, weights);
  for (int region = 0; region < 2; ++region) {
    gmsh::model::getPhysicalName(3, region + 1, result.names[region]);
    std::vector<double> jacobians;
    std::vector<double> determinants;
    std::vector<double> positions;
    gmsh::model::mesh::getJacobians(element_type, points, jacobians, determinants, positions, region + 1);
    result.n_elements[region] = determinants.size() / weights.size();
    for (std::size_t i = 0; i < determinants.size(); ++i) {
      result.volume[region] += weights[i % weights.size()] * determinants[i];
      result.smallest_determinant = std::min(result.smallest_determinant, determinants[i]);
    }
  }
  read_membranes(face_type, result);
  std::vector<int> views;
  gmsh::view::getTags(views);
  result.n_views = views.size();
  return result;
}

double shell_volume(const VolumeMesh& mesh, const FrozenShape& shape) {
  return 4.0 / 3.0 * std::numbers::pi * std::pow(mesh.outer_radius(), 3) - shape.volume();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(msh_file)

BOOST_AUTO_TEST_CASE(hexahedra_come_back_curved_and_right_handed) {
  const FrozenShape shape = shape_33();
  const HexMesh mesh = make_block_mesh(shape);
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "mesh.msh";
  write_msh(file, mesh, quality(mesh, shape));
  const ReadBack found = read_back(file, 12, 10);
  BOOST_TEST(found.n_elements[0] == 256u);
  BOOST_TEST(found.n_elements[1] == 384u);
  BOOST_TEST(found.names[0] == "inside");
  BOOST_TEST(found.names[1] == "outside");
  BOOST_TEST(found.smallest_determinant > 0.0);
  BOOST_TEST(std::abs(found.volume[0] / shape.volume() - 1.0) < 1e-3);
  BOOST_TEST(std::abs(found.volume[1] / shell_volume(mesh, shape) - 1.0) < 1e-3);
  BOOST_TEST(found.n_views == 1u);
  // Nodes on a lattice of 8 steps per edge: 9³ in the core cube, 6 · 8² + 2 on each of 4 and 8 further layers, and
  // those on the membrane a second time.
  for (const int side : {0, 1}) {
    BOOST_TEST(found.membranes[side] == (side == 0 ? "membrane" : "membrane_outside"));
    BOOST_TEST(std::abs(found.area[side] / shape.area() - 1.0) < 1e-3);
    BOOST_TEST(std::abs(found.enclosed[side] / found.volume[0] - 1.0) < 1e-10);
  }
  BOOST_TEST(found.n_nodes == 729u + 386u * 4u + 386u * 8u + 386u);
}

BOOST_AUTO_TEST_CASE(tetrahedra_come_back_curved_and_right_handed) {
  const FrozenShape shape = disc();
  const TetMesh mesh = make_tetrahedral_mesh(shape);
  const MeshQuality expected = quality(mesh, shape);
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "mesh.msh";
  write_msh(file, mesh, expected);
  const ReadBack found = read_back(file, 11, 9);
  BOOST_TEST(found.n_elements[0] + found.n_elements[1] == std::size_t(mesh.n_cells()));
  BOOST_TEST(found.smallest_determinant > 0.0);
  BOOST_TEST(std::abs(found.volume[0] / expected.volume_inside - 1.0) < 1e-10);
  BOOST_TEST(std::abs(found.volume[1] / shell_volume(mesh, shape) - 1.0) < 2e-3);
  for (const int side : {0, 1}) BOOST_TEST(std::abs(found.enclosed[side] / found.volume[0] - 1.0) < 1e-10);
  BOOST_TEST(found.n_views == 1u);
}

BOOST_AUTO_TEST_CASE(quality_of_the_second_order_mesh_is_that_of_the_file) {
  const FrozenShape shape = shape_33();
  const HexMesh exact = make_block_mesh(shape);
  const SecondOrderMesh mesh(exact);
  const MeshQuality figures = quality(mesh, shape);
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "mesh.msh";
  write_msh(file, mesh, figures);
  const ReadBack found = read_back(file, 12, 10);
  BOOST_TEST(std::abs(figures.volume_inside / found.volume[0] - 1.0) < 1e-12);
  BOOST_TEST(std::abs(figures.area / found.area[0] - 1.0) < 1e-4);
  // The exact map would give a far smaller error.
  BOOST_TEST(std::abs(figures.volume_error) > 10.0 * std::abs(quality(exact, shape).volume_error));
}

BOOST_AUTO_TEST_CASE(missing_folder_is_an_error_that_names_it) {
  const FrozenShape shape = prolate();
  const HexMesh mesh = make_block_mesh(shape);
  try {
    write_msh("/nowhere/at/all/mesh.msh", mesh, quality(mesh, shape));
    BOOST_ERROR("a file in a missing folder was written");
  } catch (const MeshError& error) {
    BOOST_TEST(std::string(error.what()).find("/nowhere/at/all") != std::string::npos);
  }
}

BOOST_AUTO_TEST_SUITE_END()
