#include "bie/pictures/view.hpp"

#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>

#include "bie/pictures/shapes_key.hpp"
#include "bie/support/errors.hpp"

using namespace vehd;

namespace {

const Matrix3 sphere = Matrix3::Identity();

Scene with_field(const Triple& field) {
  Scene scene;
  scene.electric.emplace().field = field;
  return scene;
}

Scene with_flow(FlowKind kind) {
  Scene scene;
  scene.flow.emplace().kind = kind;
  return scene;
}

Vector3 eye(const Matrix3& view) { return view.row(2).transpose(); }

}  // namespace

BOOST_AUTO_TEST_SUITE(view)

BOOST_AUTO_TEST_CASE(axes_lie_as_they_are_drawn) {
  for (const auto& [name, right, up] : {std::tuple{"x", 1, 2}, {"y", 0, 2}, {"z", 0, 1}}) {
    const Matrix3 frame = parse_view(name);
    BOOST_TEST((frame.row(0).transpose() - Vector3::Unit(right)).norm() < 1e-15, name);
    BOOST_TEST((frame.row(1).transpose() - Vector3::Unit(up)).norm() < 1e-15, name);
  }
  for (const char* direction : {"1,1,0.5", "0,0,-2", "-3,0.1,7", "0.001,0,1"}) {
    const Matrix3 frame = parse_view(direction);
    BOOST_TEST((frame * frame.transpose() - sphere).norm() < 1e-14, direction);
    BOOST_TEST(frame.determinant() > 0.0, direction);
  }
  for (const char* wrong : {"", "w", "1,1", "1,1,1,1", "0,0,0", "1;2;3", "nan,0,1", "1,0,0 x"}) {
    BOOST_CHECK_THROW(parse_view(wrong), InputError);
  }
}

BOOST_AUTO_TEST_CASE(the_default_looks_across_the_plane_of_flow_and_field) {
  // Shear and planar extension lie in the plane of x and z.
  BOOST_TEST((default_view(with_flow(FlowKind::shear), sphere) - parse_view("y")).norm() < 1e-12);
  BOOST_TEST((default_view(with_flow(FlowKind::planar_extension), sphere) - parse_view("y")).norm() < 1e-12);
  BOOST_TEST((default_view(with_field({0.0, 0.0, 1.0}), sphere) - parse_view("y")).norm() < 1e-12);
  BOOST_TEST((default_view(with_field({0.0, 5.0, 0.0}), sphere) - parse_view("z")).norm() < 1e-12);
  // Flow and field span a plane that is normal to no axis.
  Scene both = with_field({0.0, 1.0, 1.0});
  both.flow = with_flow(FlowKind::poiseuille).flow;
  const Vector3 seen_from = eye(default_view(both, sphere));
  BOOST_TEST(std::abs(seen_from.dot(Vector3(0.0, 1.0, 1.0))) < 1e-9);
  BOOST_TEST(std::abs(seen_from.x()) < 1e-9);
}

BOOST_AUTO_TEST_CASE(without_flow_and_field_the_axis_of_the_shape_lies_in_the_plane) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double moment : {0.3, 3.0}) {
      Matrix3 gyration = Matrix3::Identity();
      gyration(axis, axis) = moment;
      BOOST_TEST(std::abs(eye(default_view(Scene(), gyration))[axis]) < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(arrows_of_a_flow_between_planes_are_equal_along_them) {
  Scene scene = with_flow(FlowKind::poiseuille);
  scene.flow->section = FlowSection::slit;
  Page page;
  draw_key_item(page, KeyItem::flow, {0.0, 0.0, key_width, key_height(KeyItem::flow)},
                {scene, parse_view("z"), 1.0, {}});
  BOOST_TEST(page.lines.size() == 8U);
  for (const PageLine& arrow : page.lines) {
    BOOST_TEST(arrow.points[1][0] - arrow.points[0][0] == 9.0, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_SUITE_END()
