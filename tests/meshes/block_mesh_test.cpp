#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "meshes/mesh_quality.hpp"
#include "tests/meshes/mesh_checks.hpp"
#include "tests/meshes/shapes.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

namespace {

BlockMeshOptions coarse() {
  BlockMeshOptions options;
  options.cells_per_edge = 2;
  options.blend_layers = 1;
  options.shell_layers = 3;
  return options;
}

/// Message of the MeshError thrown when making a mesh; empty if there is none.
std::string mesh_error(const FrozenShape& shape, const BlockMeshOptions& options) {
  try {
    make_block_mesh(shape, options);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(block_mesh)

BOOST_AUTO_TEST_CASE(thirteen_blocks_have_the_cells_that_the_options_ask_for) {
  const HexMesh mesh = make_block_mesh(prolate(), coarse());
  // 2³ in the core, 6 · 2² in each layer.
  BOOST_TEST(mesh.n_cells() == 8 + 24 * 4);
  const FaceCounts faces = count_faces(mesh);
  BOOST_TEST(faces.wrong == 0);
  BOOST_TEST(faces.membrane == 2 * 24);
  BOOST_TEST(faces.outer == 24);
  BOOST_TEST(mesh.interface().size() == 24u);
  BOOST_TEST(mesh.topology().interface_vertices.size() == 26u);
}

BOOST_AUTO_TEST_CASE(both_cells_at_a_face_map_it_to_the_same_points) {
  for (const auto& [name, shape] : all_shapes()) {
    const FaceCounts faces = count_faces(make_block_mesh(shape, coarse()));
    BOOST_TEST(faces.largest_gap < 1e-13, name);
    BOOST_TEST(faces.shared > 100, name);
  }
}

BOOST_AUTO_TEST_CASE(membrane_lies_on_the_shape_everywhere_and_the_outer_boundary_on_its_sphere) {
  for (const auto& [name, shape] : all_shapes()) {
    const HexMesh mesh = make_block_mesh(shape, coarse());
    const SheetGaps gaps = sheet_gaps(mesh, shape);
    BOOST_TEST(gaps.off_shape < 1e-13, name);
    BOOST_TEST(gaps.position < 1e-13, name);
    BOOST_TEST(gaps.direction < 1e-14, name);
    BOOST_TEST(off_outer_sphere(mesh) < 1e-13, name);
  }
}

BOOST_AUTO_TEST_CASE(interface_has_two_coincident_sheets) {
  const HexMesh mesh = make_block_mesh(shape_33(), coarse());
  BOOST_TEST(mesh.topology().interface_vertices.size() == 26);
  BOOST_TEST(vertices_of_both_regions(mesh) == 0);
  BOOST_TEST(vertex_pair_gap(mesh) < 1e-14);
}

BOOST_AUTO_TEST_CASE(jacobian_is_the_derivative_of_the_map) {
  for (const auto& [name, shape] : all_shapes()) {
    const HexMesh mesh = make_block_mesh(shape, coarse());
    BOOST_TEST(jacobian_error(mesh) < 1e-8, name);
    BOOST_TEST(batch_gap(mesh) < 1e-13, name);
  }
}

BOOST_AUTO_TEST_CASE(every_shape_has_well_formed_elements) {
  // A ball divided into blocks has the value 1/√3 at the corners of its core, at every resolution.
  BOOST_TEST(
      std::abs(quality(make_block_mesh(off_centre_sphere(), coarse()), off_centre_sphere()).smallest_scaled_jacobian -
               std::sqrt(1.0 / 3.0)) < 1e-3);
  for (const auto& [name, shape] : all_shapes()) {
    const MeshQuality found = quality(make_block_mesh(shape), shape);
    BOOST_TEST(found.smallest_scaled_jacobian > 0.18, name);
    BOOST_TEST(found.smallest_size > 0.08, name);
  }
}

BOOST_AUTO_TEST_CASE(tilted_disc_is_meshed_as_well_as_the_flat_one) {
  const double flat = quality(make_block_mesh(disc(), coarse()), disc()).smallest_scaled_jacobian;
  const double rotated = quality(make_block_mesh(rotated_disc(), coarse()), rotated_disc()).smallest_scaled_jacobian;
  BOOST_TEST(std::abs(flat - rotated) < 0.02);
}

BOOST_AUTO_TEST_CASE(volume_and_area_converge_at_the_order_of_the_quadrature) {
  // The map is exact, so the error is that of two Gauss points per direction, of fourth order.
  for (const auto& [name, shape] : all_shapes()) {
    BlockMeshOptions options = coarse();
    // On coarser meshes the area errors of shape (33) and of the disc still pass through zero.
    options.shell_layers = 1;
    options.cells_per_edge = 7;
    options.blend_layers = 3;
    const MeshQuality wide = quality(make_block_mesh(shape, options), shape, 2);
    options.cells_per_edge = 14;
    options.blend_layers = 6;
    const MeshQuality fine = quality(make_block_mesh(shape, options), shape, 2);
    BOOST_TEST(std::log2(std::abs(wide.volume_error / fine.volume_error)) > 3.5, name);
    BOOST_TEST(std::log2(std::abs(wide.area_error / fine.area_error)) > 3.5, name);
    BOOST_TEST(std::abs(fine.volume_error) < 2e-6, name);
    BOOST_TEST(std::abs(fine.area_error) < 1e-6, name);
  }
}

BOOST_AUTO_TEST_CASE(shell_is_graded_by_its_growth) {
  BlockMeshOptions options = coarse();
  options.shell_growth = 3.0;
  const HexMesh mesh = make_block_mesh(off_centre_sphere(), options);
  // Three layers of 1, 3 and 9 parts between 1.2 and 8.
  for (const InterfacePair& pair : mesh.interface()) {
    const Point x = mesh.physical(pair.outside_cell, {0.5, 0.5, 1.0});
    BOOST_TEST(std::abs((x - mesh.centre()).norm() - (1.2 + (8.0 - 1.2) / 13.0)) < 1e-5);
  }
}

BOOST_AUTO_TEST_CASE(two_runs_give_the_same_mesh) {
  BOOST_TEST(identical(make_block_mesh(shape_33(), coarse()), make_block_mesh(shape_33(), coarse())));
}

BOOST_AUTO_TEST_CASE(cells_are_relaxed_where_straight_lines_fold) {
  const FrozenShape shape = bowl();
  BlockMeshOptions options = coarse();
  options.cells_per_edge = 1;
  options.shell_growth = 3.0;
  const HexMesh mesh = make_block_mesh(shape, options);
  // With an odd number of cells some would contain a kink of the map, so the number is made even.
  BOOST_TEST(mesh.n_cells() == 8 + 24 * 4);
  constexpr int gauss_points = 6;
  const MeshQuality found = quality(mesh, shape, gauss_points);
  BOOST_TEST(found.smallest_scaled_jacobian > 0.1);
  BOOST_TEST(std::abs(found.volume_error) < 1e-6);
  BOOST_TEST(std::abs(found.area_error) < 1e-4);
  const SheetGaps gaps = sheet_gaps(mesh, shape);
  BOOST_TEST(gaps.off_shape < 1e-13);
  BOOST_TEST(gaps.position < 1e-13);
  BOOST_TEST(gaps.direction < 1e-14);
  BOOST_TEST(off_outer_sphere(mesh) < 1e-13);
  BOOST_TEST(jacobian_error(mesh) < 1e-8);
  BOOST_TEST(batch_gap(mesh) < 1e-13);
  const FaceCounts faces = count_faces(mesh);
  BOOST_TEST(faces.wrong == 0);
  BOOST_TEST(faces.largest_gap < 1e-13);
}

BOOST_AUTO_TEST_CASE(flat_elements_and_small_outer_spheres_are_errors) {
  const HexMesh ball = make_block_mesh(off_centre_sphere(), coarse());
  const auto too_flat = [](const MeshError& error) {
    return std::string(error.what()).find("too flat: scaled Jacobian 0.57") != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(require_quality(quality(ball, off_centre_sphere()), 0.6), MeshError, too_flat);
  BlockMeshOptions options = coarse();
  options.outer_radius = 1.9;
  BOOST_TEST(mesh_error(prolate(), options).find("outer radius 1.9 does not enclose") != std::string::npos);
  options = coarse();
  options.shell_layers = 0;
  BOOST_CHECK_THROW(make_block_mesh(prolate(), options), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(core_has_no_direction) {
  const HexMesh mesh = make_block_mesh(prolate(), coarse());
  int without = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    try {
      (void)mesh.direction(c, Point::Constant(0.5));
    } catch (const std::logic_error&) {
      ++without;
    }
  }
  BOOST_TEST(without == 8);
}

BOOST_AUTO_TEST_SUITE_END()
