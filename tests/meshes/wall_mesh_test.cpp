#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "meshes/box_mesh.hpp"
#include "meshes/mesh_quality.hpp"
#include "tests/meshes/mesh_checks.hpp"
#include "tests/meshes/shapes.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

namespace {

/// Arbitrary wall normal.
const Point kNormal = Point(1.0, -2.0, 0.5).normalized();

/// Wall beside a shape, at the given gap from the nearest point of a fine grid.
Wall wall_at(const FrozenShape& shape, double gap, const Point& normal = kNormal) {
  double lowest = std::numeric_limits<double>::max();
  for_each_sphere_point(120, [&](const Point& r, double) { lowest = std::min(lowest, normal.dot(shape.position(r))); });
  return {(lowest - gap) * normal + Point(3.0, 1.0, 2.0).cross(normal), normal};
}

BoxMeshOptions options_of(int cells_per_edge, double outer_radius = 8.0) {
  BoxMeshOptions options;
  options.cells_per_edge = cells_per_edge;
  options.boxes.outer_radius = outer_radius;
  return options;
}

std::string mesh_error(const FrozenShape& shape, const Wall& wall, const BoxMeshOptions& options = {}) {
  try {
    make_mesh_beside_wall(shape, wall, options);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

/// Volume of the outside; for each kind of face its area and the vector ∫ n dA, with n out of the cell.
struct Measures {
  double volume = 0.0;
  std::map<FaceKind, double> area;
  std::map<FaceKind, Point> vector;
};

Measures measures_of(const VolumeMesh& mesh, int n_gauss) {
  const GaussRule rule = gauss_rule(n_gauss);
  Measures result;
  for (const FaceKind kind : {FaceKind::membrane, FaceKind::outer_sphere, FaceKind::wall}) {
    result.vector[kind] = Point::Zero();
  }
  const auto at = [&](int i) { return 0.5 + 0.5 * rule.node[static_cast<std::size_t>(i)]; };
  const auto weight = [&](int i) { return 0.5 * rule.weight[static_cast<std::size_t>(i)]; };
  for (int c = 0; c < mesh.n_cells(); ++c) {
    if (mesh.cell(c).region == Region::inside) continue;
    for (int i = 0; i < n_gauss; ++i) {
      for (int j = 0; j < n_gauss; ++j) {
        for (int k = 0; k < n_gauss; ++k) {
          result.volume +=
              weight(i) * weight(j) * weight(k) * mesh.jacobian(c, Point(at(i), at(j), at(k))).determinant();
        }
        for (int face = 0; face < 6; ++face) {
          const FaceKind kind = mesh.cell(c).faces[face];
          if (kind == FaceKind::interior) continue;
          const int axis = face / 2, first = (axis + 1) % 3, second = (axis + 2) % 3;
          Point unit;
          unit[axis] = face % 2;
          unit[first] = at(i);
          unit[second] = at(j);
          const Matrix3 slope = mesh.jacobian(c, unit);
          const Point area = (face % 2 == 1 ? 1.0 : -1.0) * slope.col(first).cross(slope.col(second));
          result.area[kind] += weight(i) * weight(j) * area.norm();
          result.vector[kind] += weight(i) * weight(j) * area;
        }
      }
    }
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(wall_mesh)

BOOST_AUTO_TEST_CASE(eighteen_blocks_meet_face_to_face_and_end_on_the_wall) {
  const FrozenShape shape = asymmetric();
  const BoxMesh mesh = make_mesh_beside_wall(shape, wall_at(shape, 0.2), options_of(2));
  // 2³ in the core, 6 · 2² in each of 3 layers about it, 5 · 2² in each of 2 layers about the box.
  BOOST_TEST(mesh.n_cells() == 8 + 24 * 3 + 20 * 2);
  BOOST_TEST(mesh.n_vesicles() == 1);
  const FaceCounts faces = count_faces(mesh);
  BOOST_TEST(faces.wrong == 0);
  BOOST_TEST(faces.membrane == 48);
  BOOST_TEST(faces.outer == 20);
  // The faces below the box, and a strip of 2 faces in both layers at each of its four edges.
  BOOST_TEST(faces.wall == 4 + 4 * 2 * 2);
  BOOST_TEST(faces.largest_gap < 1e-13);
  BOOST_TEST(vertices_of_both_regions(mesh) == 0);
  BOOST_TEST(vertex_pair_gap(mesh) < 1e-13);
  const SheetGaps gaps = sheet_gaps(mesh, shape);
  BOOST_TEST(gaps.position < 1e-13);
  BOOST_TEST(gaps.direction < 1e-13);
  BOOST_TEST(gaps.off_shape < 1e-13);
  BOOST_TEST(off_outer_sphere(mesh) < 1e-12);
  BOOST_TEST(jacobian_error(mesh) < 1e-8);
  BOOST_TEST(batch_gap(mesh) < 1e-13);
}

BOOST_AUTO_TEST_CASE(wall_faces_lie_in_the_wall_and_everything_else_above_it) {
  const FrozenShape shape = asymmetric();
  for (const Point& normal : {kNormal, Point(Point::UnitZ()), Point(-Point::UnitX())}) {
    const Wall wall = wall_at(shape, 0.1, normal);
    const BoxMesh mesh = make_mesh_beside_wall(shape, wall, options_of(3));
    BOOST_TEST(mesh.wall().has_value());
    const auto height = [&](const Point& x) { return wall.normal.dot(x - wall.point); };
    BOOST_TEST(std::abs(height(mesh.centre())) < 1e-13);
    for (int c = 0; c < mesh.n_cells(); ++c) {
      for (int face = 0; face < 6; ++face) {
        Point unit(0.3, 0.6, 0.7);
        unit[face / 2] = face % 2;
        const double at_face = height(mesh.physical(c, unit));
        if (mesh.cell(c).faces[face] == FaceKind::wall) {
          BOOST_TEST(std::abs(at_face) < 1e-13);
        } else {
          BOOST_TEST(at_face > 1e-3);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(volume_and_areas_are_those_of_the_half_space_and_converge) {
  const FrozenShape shape = asymmetric();
  const Wall wall = wall_at(shape, 0.2);
  constexpr double radius = 8.0, pi = std::numbers::pi;
  const double volume = 2.0 / 3.0 * pi * std::pow(radius, 3) - shape.volume();
  std::array<double, 3> errors{};
  for (int level = 0; level < 3; ++level) {
    const Measures found = measures_of(make_mesh_beside_wall(shape, wall, options_of(2 + level)), 5);
    errors[level] = std::abs(found.volume / volume - 1.0);
    const double of_wall = found.area.at(FaceKind::wall) / (pi * radius * radius) - 1.0;
    const double of_sphere = found.area.at(FaceKind::outer_sphere) / (2.0 * pi * radius * radius) - 1.0;
    BOOST_TEST_MESSAGE("volume " << errors[level] << ", wall " << of_wall << ", sphere " << of_sphere);
    BOOST_TEST(std::abs(of_wall) < 1e-4);
    BOOST_TEST(std::abs(of_sphere) < 1e-4);
    // Normals point out of the fluid: against the wall's, along the half sphere's; the membrane is closed.
    BOOST_TEST((found.vector.at(FaceKind::wall) / (pi * radius * radius) + wall.normal).norm() < 1e-4);
    BOOST_TEST((found.vector.at(FaceKind::outer_sphere) / (pi * radius * radius) - wall.normal).norm() < 1e-4);
    BOOST_TEST(found.vector.at(FaceKind::membrane).norm() < 1e-3);
  }
  BOOST_TEST(errors[1] < 0.2 * errors[0]);
  BOOST_TEST(errors[2] < 0.3 * errors[1]);
  BOOST_TEST(errors[2] < 1e-6);
}

BOOST_AUTO_TEST_CASE(elements_are_well_formed_at_every_gap_and_fit_into_it) {
  const auto require_well_formed = [](const std::string& name, const FrozenShape& shape, const Point& normal,
                                      double gap, double least) {
    const BoxMesh mesh = make_mesh_beside_wall(shape, wall_at(shape, gap, normal), options_of(4, 4.0 * (gap + 3.0)));
    const MeshQuality found = quality(mesh, shape, 8);
    BOOST_TEST_MESSAGE(name << ", gap " << gap << ": scaled Jacobian " << found.smallest_scaled_jacobian << " at "
                            << found.worst_position.transpose());
    BOOST_TEST_CONTEXT(name << ", gap " << gap) {
      BOOST_TEST(found.smallest_scaled_jacobian > least);
      BOOST_TEST(std::abs(found.volume_error) < 1e-6);
    }
  };
  const std::array<NamedShape, 4> shapes{{{"off-centre sphere", off_centre_sphere()},
                                          {"prolate", prolate()},
                                          {"shape (33)", shape_33()},
                                          {"asymmetric", asymmetric()}}};
  for (const NamedShape& named : shapes) {
    for (const auto& [gap, least] :
         {std::pair(10.0, 0.3), std::pair(1.0, 0.3), std::pair(0.1, 0.15), std::pair(0.03, 0.03)}) {
      require_well_formed(named.name, named.shape, kNormal, gap, least);
    }
  }
  require_well_formed("off-centre sphere", off_centre_sphere(), kNormal, 0.001, 0.2);
}

// A membrane that sinks and flattens has its points in the same directions all the time.
BOOST_AUTO_TEST_CASE(directions_are_those_of_a_shape_before_or_after) {
  const FrozenShape end = asymmetric();
  const Wall wall = wall_at(end, 0.1);
  const Point along(0.4, 0.0, 0.2);
  const Matrix3 stretch = Matrix3::Identity() + along * along.transpose();
  const FrozenShape earlier(project(16, [&](const Point& r) { return Point(stretch * end.position(r) + kNormal); }));
  const BoxMesh of_end = make_mesh_beside_wall(end, wall, options_of(3));
  const BoxMesh of_earlier = make_mesh_beside_wall(earlier, end, wall, options_of(3));
  const BoxMesh of_itself = make_mesh_beside_wall(earlier, wall, options_of(3));
  double same = 0.0, other = 0.0;
  for (int c = 0; c < of_end.n_cells(); ++c) {
    if (std::ranges::count(of_end.cell(c).faces, FaceKind::membrane) == 0) continue;
    const Point unit(0.3, 0.6, 0.7), direction = of_end.direction(c, unit);
    same = std::max(same, (of_earlier.direction(c, unit) - direction).norm());
    other = std::max(other, (of_itself.direction(c, unit) - direction).norm());
  }
  BOOST_TEST(same < 1e-14);
  BOOST_TEST(other > 1e-3);
  BOOST_TEST(count_faces(of_earlier).wrong == 0);
  BOOST_TEST(sheet_gaps(of_earlier, earlier).off_shape < 1e-13);
  BOOST_TEST(jacobian_error(of_earlier) < 1e-8);
  BOOST_TEST(quality(of_earlier, earlier, 8).smallest_scaled_jacobian > 0.15);
}

BOOST_AUTO_TEST_CASE(mesh_does_not_depend_on_unit_or_place) {
  const FrozenShape shape = asymmetric();
  const Wall wall = wall_at(shape, 0.2);
  const BoxMesh here = make_mesh_beside_wall(shape, wall, options_of(2));
  const Point way(1.0, -2.0, 3.0);
  const FrozenShape moved(project(16, [&](const Point& r) { return Point(1e-6 * (shape.position(r) + way)); }));
  const BoxMesh there = make_mesh_beside_wall(moved, {1e-6 * (wall.point + way), wall.normal}, options_of(2, 8e-6));
  for (int c = 0; c < here.n_cells(); ++c) {
    const Point expected = 1e-6 * (here.physical(c, {0.3, 0.6, 0.8}) + way);
    BOOST_TEST((there.physical(c, {0.3, 0.6, 0.8}) - expected).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(walls_that_cannot_be_meshed_are_refused) {
  const FrozenShape shape = asymmetric();
  BOOST_TEST(mesh_error(shape, wall_at(shape, -0.3)).find("the membrane reaches 0.") == 0);
  BOOST_TEST(mesh_error(shape, wall_at(shape, 0.3), options_of(2, 3.0)).find("outer radius 3 does not enclose") == 0);
}

BOOST_AUTO_TEST_SUITE_END()
