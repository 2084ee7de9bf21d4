#include "fem_check/app/refinement.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/meshes/shapes.hpp"

BOOST_AUTO_TEST_SUITE(refinement)

namespace {

using vehd::fem_check::Refinement;
using vehd::meshes::FrozenShape;
using vehd::meshes::Point;
namespace shapes = vehd::meshes::testing;

FrozenShape ellipsoid(double width, double height) {
  return FrozenShape(
      shapes::project(1, [&](const Point& r) { return Point(width * r.x(), width * r.y(), height * r.z()); }));
}

/// A disc bent into a bowl, with a rim as narrow as that of a stomatocyte.
FrozenShape bowl(double thickness) {
  return FrozenShape(shapes::project(5, [&](const Point& r) {
    const Point flat = shapes::disc_point(r);
    return Point(flat.x(), flat.y(), thickness * flat.z() + 0.9 * (1.0 - r.z() * r.z()));
  }));
}

int highest_degree(const Refinement& refinement) { return refinement.flow_degrees.back(); }

}  // namespace

BOOST_AUTO_TEST_CASE(strongly_bent_shapes_have_smaller_cells_and_bowls_higher_degrees) {
  const Refinement usual = Refinement::finest();
  for (const FrozenShape& shape : {shapes::off_centre_sphere(), shapes::prolate(), shapes::shape_33()}) {
    const Refinement found = Refinement::following(shape);
    BOOST_TEST(found.cells_per_edge == usual.cells_per_edge);
    BOOST_TEST(found.shell_layers == usual.shell_layers);
    BOOST_TEST(highest_degree(found) == highest_degree(usual));
  }
  for (const FrozenShape& shape : {ellipsoid(1.0, 5.0), ellipsoid(1.0, 0.2)}) {
    const Refinement found = Refinement::following(shape);
    BOOST_TEST(found.cells_per_edge == 6);
    BOOST_TEST(highest_degree(found) < highest_degree(usual));
  }
  const Refinement of_bowl = Refinement::following(bowl(0.5));
  BOOST_TEST(of_bowl.cells_per_edge == 4);
  BOOST_TEST(of_bowl.shell_layers > usual.shell_layers);
  BOOST_TEST(highest_degree(of_bowl) == highest_degree(usual));
}

BOOST_AUTO_TEST_SUITE_END()
