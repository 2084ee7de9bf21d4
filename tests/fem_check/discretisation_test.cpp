#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(discretisation)

BOOST_AUTO_TEST_CASE(membrane_points_lie_on_the_shape_with_its_normal_and_area) {
  const vehd::meshes::FrozenShape shape = shapes::asymmetric();
  const Discretisation space = discretise(shape, {.cells_per_edge = 4, .degree = 5});
  const SurfacePoints points = space.quadrature_points(8);
  BOOST_TEST(std::abs(points.weight.sum() / shape.area() - 1.0) < 1e-6);
  const Vector flux = sampled(points, [](const Vector3& x, const Vector3& n) { return x.dot(n) / 3.0; });
  BOOST_TEST(std::abs(points.weight.dot(flux) / shape.volume() - 1.0) < 1e-6);
  BOOST_TEST((points.position - shape.positions(points.direction)).cwiseAbs().maxCoeff() < 1e-4);
  for (Eigen::Index i = 0; i < points.size(); i += 17) {
    const Vector3 normal = shape.area_vector(points.direction.col(i)).normalized();
    BOOST_TEST((points.normal.col(i) - normal).norm() < 1e-2);
  }
}

BOOST_AUTO_TEST_CASE(angles_are_those_of_the_direction) {
  const Discretisation space = discretise(shapes::disc(), {.degree = 2});
  const SurfacePoints points = space.lattice_points(3);
  BOOST_TEST(points.size() == 16 * space.n_faces());
  const Vector theta = points.theta();
  const Vector phi = points.phi();
  for (Eigen::Index i = 0; i < points.size(); i += 7) {
    BOOST_TEST((vehd::meshes::direction_of(theta[i], phi[i]) - points.direction.col(i)).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(every_point_of_a_lattice_is_found_again) {
  const Discretisation space = discretise(shapes::shape_33(), {.degree = 3});
  const VolumePoints lattice = space.volume_lattice(2);
  std::vector<Eigen::Index> middles;  // of cells; each lies in one cell only
  for (int c = 0; c < space.n_cells(); ++c) middles.push_back(27 * c + 13);
  const VolumePoints found = space.locate(lattice.position(Eigen::all, middles));
  for (int c = 0; c < space.n_cells(); ++c) {
    BOOST_TEST(found.cell[c] == c);
    BOOST_TEST((found.unit.col(c) - Vector3::Constant(0.5)).norm() < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(points_close_to_the_membrane_get_their_side) {
  const Discretisation space = discretise(shapes::prolate(), {.degree = 4});
  const SurfacePoints points = space.quadrature_points(2);
  const VolumePoints inside = space.locate(points.position - 1e-3 * points.normal);
  const VolumePoints outside = space.locate(points.position + 1e-3 * points.normal);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    BOOST_TEST(inside.inside[i]);
    BOOST_TEST(!outside.inside[i]);
  }
}

BOOST_AUTO_TEST_SUITE_END()
