#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "meshes/box_mesh.hpp"
#include "meshes/mesh_quality.hpp"
#include "meshes/separating_plane.hpp"
#include "tests/meshes/mesh_checks.hpp"
#include "tests/meshes/two_shapes.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

namespace {

std::vector<FrozenShape> list_of(const std::array<FrozenShape, 2>& shapes) { return {shapes[0], shapes[1]}; }

/// Message of the MeshError thrown when making a mesh; empty if there is none.
std::string mesh_error(const std::array<FrozenShape, 2>& shapes, const BoxMeshOptions& options = {}) {
  try {
    make_two_vesicle_mesh(shapes, options);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(two_vesicle_mesh)

BOOST_AUTO_TEST_CASE(thirty_six_blocks_meet_face_to_face) {
  BoxMeshOptions options;
  options.cells_per_edge = 2;
  options.boxes.outer_radius = 12.0;
  const BoxMesh mesh = make_two_vesicle_mesh(two_shapes(0.2), options);
  // 2³ in a core, 6 · 2² in each of 3 layers about it, 10 · 2² in each of 2 layers about both boxes.
  BOOST_TEST(mesh.n_cells() == 2 * (8 + 24 * 3) + 40 * 2);
  BOOST_TEST(mesh.n_vesicles() == 2);
  const FaceCounts faces = count_faces(mesh);
  BOOST_TEST(faces.wrong == 0);
  BOOST_TEST(faces.membrane == 2 * 48);
  BOOST_TEST(faces.outer == 40);
  BOOST_TEST(faces.largest_gap < 1e-13);
  BOOST_TEST(mesh.interface().size() == 48u);
  BOOST_TEST(mesh.topology().interface_vertices.size() == 52u);
  BOOST_TEST(vertices_of_both_regions(mesh) == 0);
  BOOST_TEST(vertex_pair_gap(mesh) < 1e-13);
  for (const InterfacePair& pair : mesh.interface()) {
    BOOST_TEST(mesh.cell(pair.inside_cell).vesicle == mesh.cell(pair.outside_cell).vesicle);
  }
}

BOOST_AUTO_TEST_CASE(membranes_lie_on_their_shapes_and_the_outer_boundary_on_its_sphere) {
  const std::array<FrozenShape, 2> shapes = two_shapes(0.2);
  BoxMeshOptions options;
  options.boxes.outer_radius = 12.0;
  const BoxMesh mesh = make_two_vesicle_mesh(shapes, options);
  for_each_membrane_point(mesh, [&](const InterfacePair& pair, const Point& inside) {
    const Point outside = mesh.across(pair, inside);
    const Point x = mesh.physical(pair.inside_cell, inside);
    const Point r = mesh.direction(pair.inside_cell, inside);
    BOOST_TEST((x - mesh.physical(pair.outside_cell, outside)).norm() < 1e-13);
    BOOST_TEST((r - mesh.direction(pair.outside_cell, outside)).norm() < 1e-13);
    BOOST_TEST((x - shapes[mesh.cell(pair.inside_cell).vesicle].position(r)).norm() < 1e-13);
  });
  BOOST_TEST(off_outer_sphere(mesh) < 1e-12);
}

BOOST_AUTO_TEST_CASE(jacobian_is_the_derivative_of_the_map) {
  BoxMeshOptions options;
  options.boxes.outer_radius = 12.0;
  const BoxMesh mesh = make_two_vesicle_mesh(two_shapes(1.0), options);
  BOOST_TEST(jacobian_error(mesh) < 1e-8);
  BOOST_TEST(batch_gap(mesh) < 1e-13);
}

BOOST_AUTO_TEST_CASE(plane_lies_across_the_gap_in_its_middle) {
  for (const double gap : {1.0, 0.2, 0.05}) {
    const std::array<FrozenShape, 2> shapes = two_shapes(gap);
    const SeparatingPlane plane = separating_plane(shapes[0], shapes[1]);
    BOOST_TEST_CONTEXT("gap " << gap) {
      BOOST_TEST(plane.width > 0.94 * gap);
      // Sample points on smooth surfaces miss the nearest pair of points.
      BOOST_TEST(plane.width < gap + 3e-3);
      BOOST_TEST(plane.normal.dot(Point(1.0, 2.0, 4.0).normalized()) > 0.95);
      for_each_sphere_point(20, [&](const Point& r, double) {
        BOOST_TEST(plane.normal.dot(shapes[0].position(r)) < plane.offset - 0.4 * gap);
        BOOST_TEST(plane.normal.dot(shapes[1].position(r)) > plane.offset + 0.4 * gap);
      });
    }
  }
}

BOOST_AUTO_TEST_CASE(elements_are_well_formed_at_every_gap_and_hold_the_volumes) {
  for (const double gap : {3.0, 1.0, 0.2}) {
    const std::array<FrozenShape, 2> shapes = two_shapes(gap);
    BoxMeshOptions options;
    options.boxes.outer_radius = 12.0;
    const BoxMesh mesh = make_two_vesicle_mesh(shapes, options);
    const MeshQuality found = quality(mesh, list_of(shapes), 8);
    BOOST_TEST_MESSAGE("gap " << gap << ": scaled Jacobian " << found.smallest_scaled_jacobian << " at "
                              << found.worst_position.transpose());
    BOOST_TEST_CONTEXT("gap " << gap) {
      BOOST_TEST(found.smallest_scaled_jacobian > 0.2);
      for (const VesicleMeasures& vesicle : found.vesicles) {
        BOOST_TEST(std::abs(vesicle.volume_error) < 1e-7);
        BOOST_TEST(std::abs(vesicle.area_error) < 1e-6);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(mesh_does_not_depend_on_unit_or_place) {
  const std::array<Eigen::MatrixXd, 2> positions = two_positions(0.2);
  const auto moved = [](Eigen::MatrixXd coefficients) {
    coefficients.row(0) += std::sqrt(4.0 * std::numbers::pi) * Eigen::RowVector3d(1.0, -2.0, 3.0);
    return FrozenShape(1e-6 * coefficients);
  };
  BoxMeshOptions options;
  options.boxes.outer_radius = 12.0;
  const BoxMesh here = make_two_vesicle_mesh(two_shapes(0.2), options);
  options.boxes.outer_radius = 12e-6;
  const BoxMesh there = make_two_vesicle_mesh({moved(positions[0]), moved(positions[1])}, options);
  for (int c = 0; c < here.n_cells(); ++c) {
    const Point expected = 1e-6 * (here.physical(c, {0.3, 0.6, 0.8}) + Point(1.0, -2.0, 3.0));
    BOOST_TEST((there.physical(c, {0.3, 0.6, 0.8}) - expected).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(pairs_that_cannot_be_meshed_are_refused) {
  const std::array<FrozenShape, 2> shapes = two_shapes(0.2);
  BOOST_TEST(mesh_error({shapes[0], shapes[0]}).find("no plane separates the two membranes") == 0);
  BoxMeshOptions options;
  options.boxes.outer_radius = 3.0;
  BOOST_TEST(mesh_error(shapes, options).find("outer radius 3 does not enclose the boxes") == 0);
  options.boxes.outer_radius = 12.0;
  options.box_layers = 0;
  BOOST_CHECK_THROW(make_two_vesicle_mesh(shapes, options), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
