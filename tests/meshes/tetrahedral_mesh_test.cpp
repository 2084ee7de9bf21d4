#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "meshes/mesh_quality.hpp"
#include "tests/meshes/mesh_checks.hpp"
#include "tests/meshes/shapes.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

namespace {

TetMeshOptions of_size(double surface_size) {
  TetMeshOptions options;
  options.surface_size = surface_size;
  return options;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(tetrahedral_mesh)

BOOST_AUTO_TEST_CASE(every_shape_is_filled_without_gaps) {
  for (const auto& [name, shape] : all_shapes()) {
    const TetMesh mesh = make_tetrahedral_mesh(shape);
    const FaceCounts faces = count_faces(mesh);
    BOOST_TEST(faces.wrong == 0, name);
    BOOST_TEST(faces.largest_gap < 1e-13, name);
    BOOST_TEST(faces.membrane == 2 * int(mesh.interface().size()), name);
    // Euler: a closed triangulation of a sphere with F faces has F/2 + 2 vertices.
    BOOST_TEST(mesh.topology().interface_vertices.size() == mesh.interface().size() / 2 + 2, name);
    BOOST_TEST(faces.outer > 50, name);

    const SheetGaps gaps = sheet_gaps(mesh, shape);
    BOOST_TEST(gaps.position < 1e-13, name);
    BOOST_TEST(gaps.direction < 1e-13, name);
    BOOST_TEST(vertices_off_shape(mesh, shape) < 1e-13, name);
    BOOST_TEST(off_outer_sphere(mesh) < 1e-12, name);
    BOOST_TEST(vertices_of_both_regions(mesh) == 0, name);
    BOOST_TEST(vertex_pair_gap(mesh) < 1e-14, name);

    const MeshQuality found = quality(mesh, shape);
    BOOST_TEST(found.smallest_scaled_jacobian > 0.05, name);
    BOOST_TEST(std::abs(found.volume_error) < 2e-4, name);
    BOOST_TEST(std::abs(found.area_error) < 2e-4, name);
  }
}

BOOST_AUTO_TEST_CASE(membrane_is_quadratic) {
  const FrozenShape shape = asymmetric();
  const TetMesh mesh = make_tetrahedral_mesh(shape);
  for (const InterfacePair& pair : mesh.interface()) {
    const auto& corners = face_vertices(CellShape::tetrahedron, pair.inside_face);
    for (int k = 0; k < 3; ++k) {
      const Point a = unit_vertex(CellShape::tetrahedron, corners[k]);
      const Point b = unit_vertex(CellShape::tetrahedron, corners[(k + 1) % 3]);
      const Point middle = 0.5 * (a + b);
      const Point r = (mesh.direction(pair.inside_cell, a) + mesh.direction(pair.inside_cell, b)).normalized();
      BOOST_TEST((mesh.direction(pair.inside_cell, middle) - r).norm() < 1e-14);
      BOOST_TEST((mesh.physical(pair.inside_cell, middle) - shape.position(r)).norm() < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(geometry_converges_with_the_order_of_quadratic_elements) {
  for (const auto& [name, shape] : {NamedShape{"prolate", prolate()}, NamedShape{"asymmetric", asymmetric()}}) {
    const TetMesh wide_mesh = make_tetrahedral_mesh(shape, of_size(0.3));
    const TetMesh fine_mesh = make_tetrahedral_mesh(shape, of_size(0.15));
    const MeshQuality wide = quality(wide_mesh, shape);
    const MeshQuality fine = quality(fine_mesh, shape);
    // Edge lengths are compared by the number of faces: gmsh follows a given size only roughly.
    const double refinement = 0.5 * std::log2(double(fine_mesh.interface().size()) / wide_mesh.interface().size());
    BOOST_TEST(std::log2(wide.volume_error / fine.volume_error) / refinement > 3.3, name);
    BOOST_TEST(std::log2(wide.area_error / fine.area_error) / refinement > 3.3, name);
    const double off_wide = sheet_gaps(wide_mesh, shape).off_shape;
    const double off_fine = sheet_gaps(fine_mesh, shape).off_shape;
    BOOST_TEST(std::log2(off_wide / off_fine) / refinement > 2.0, name);
  }
}

BOOST_AUTO_TEST_CASE(elements_grow_with_the_distance_from_the_membrane) {
  const MeshQuality found = quality(make_tetrahedral_mesh(prolate()), prolate());
  BOOST_TEST(found.largest_size > 5.0 * found.smallest_size);
  TetMeshOptions options;
  options.largest_size = 0.9;
  BOOST_TEST(make_tetrahedral_mesh(prolate(), options).n_cells() > 1.3 * make_tetrahedral_mesh(prolate()).n_cells());
}

BOOST_AUTO_TEST_CASE(jacobian_is_the_derivative_of_the_map) {
  const TetMesh mesh = make_tetrahedral_mesh(disc());
  BOOST_TEST(jacobian_error(mesh) < 1e-8);
  BOOST_TEST(batch_gap(mesh) < 1e-14);
}

BOOST_AUTO_TEST_CASE(two_runs_give_the_same_mesh) {
  BOOST_TEST(identical(make_tetrahedral_mesh(disc()), make_tetrahedral_mesh(disc())));
}

BOOST_AUTO_TEST_CASE(no_cell_has_two_faces_on_the_membrane) {
  // gmsh produces such cells here; on a smooth membrane their two faces would meet at 180°.
  const TetMesh mesh = make_tetrahedral_mesh(rotated_disc(), of_size(0.25));
  for (const MeshCell& cell : mesh.topology().cells) {
    BOOST_REQUIRE(std::count(cell.faces.begin(), cell.faces.end(), FaceKind::membrane) < 2);
  }
}

BOOST_AUTO_TEST_CASE(flat_elements_are_errors_that_name_the_place) {
  TetMeshOptions options;
  options.smallest_scaled_jacobian = 0.9;
  try {
    make_tetrahedral_mesh(prolate(), options);
    BOOST_ERROR("no tetrahedral mesh is that good");
  } catch (const MeshError& error) {
    const std::string message = error.what();
    BOOST_TEST(message.find("too flat") != std::string::npos, message);
    BOOST_TEST(message.find("at least 0.9") != std::string::npos, message);
  }
  options = {};
  options.outer_radius = 1.0;
  BOOST_CHECK_THROW(make_tetrahedral_mesh(prolate(), options), MeshError);
  options = {};
  options.growth = -1.0;
  BOOST_CHECK_THROW(make_tetrahedral_mesh(prolate(), options), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(self_intersecting_shape_is_an_error) {
  // A third harmonic this large makes the surface intersect itself near the poles.
  const FrozenShape shape(
      project(4, [](const Point& r) { return Point(r.x(), r.y(), r.z() * (2.0 - 5.0 * r.x() * r.x())); }));
  BOOST_CHECK_THROW(make_tetrahedral_mesh(shape), MeshError);
}

BOOST_AUTO_TEST_SUITE_END()
