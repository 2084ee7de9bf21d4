#include <boost/test/unit_test.hpp>

#include "bie/sphere/exchange.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/rotation.hpp"
#include "tests/support/fields.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(images_of_fields)

namespace {

constexpr int kOrder = 7;

/// f at the grid direction of x.
Matrix value(const Matrix& field, const Vector3& x) {
  const double theta = std::acos(x.z() / x.norm()), phi = std::atan2(x.y(), x.x());
  return evaluate_harmonics(field, Vector::Constant(1, theta), Vector::Constant(1, phi));
}

}  // namespace

BOOST_AUTO_TEST_CASE(are_the_fields_where_they_come_from) {
  const Matrix field = smooth_coefficients(kOrder, 5, 3, 11);
  const Vector3 x(0.3, -0.7, 0.4);
  for (const Isometry& map : {Isometry{}, Isometry{{-1, 1, 1}}, Isometry{{1, -1, -1}}, Isometry{{-1, -1, -1}},
                              Isometry{{}, 1, 3}, Isometry{{}, 2, 5}, Isometry{{1, 1, -1}, 1, 4}}) {
    const Matrix3 g = map.matrix();
    const Vector3 there = g * x;
    BOOST_TEST(max_difference(value(ImageOfFields{map}.scalar(field), there), value(field, x)) < 1e-13);
    BOOST_TEST(max_difference(value(ImageOfFields{map, -1}.potential(field), there), -value(field, x)) < 1e-13);
    BOOST_TEST(max_difference(value(ImageOfFields{map}.vector(field), there),
                              Matrix((g * value(field, x).transpose()).transpose())) < 1e-13);
  }
  const ImageOfFields mirror{{{-1, 1, 1}}};
  BOOST_TEST(mirror.scalar(Vector()).size() == 0);
}

BOOST_AUTO_TEST_CASE(of_turns_are_rotated_fields) {
  const Matrix field = smooth_coefficients(kOrder, 5, 1, 12);
  const Isometry map{{}, 1, 5};
  BOOST_TEST(max_difference(ImageOfFields{map}.scalar(field), rotated_fields(field, map.matrix())) < 1e-13);
}

BOOST_AUTO_TEST_CASE(map_to_their_originals) {
  BOOST_TEST(!Exchange().any());
  BOOST_TEST(Exchange().original(3) == 3U);
  BOOST_TEST(Exchange().preimage(1, 2) == 2U);
  // Three bodies in a ring about a fourth.
  std::vector<Exchange::Map> maps;
  for (int turn = 0; turn < 3; ++turn) {
    Exchange::Map map{{{{}, turn, 3}, 1}, {}};
    for (std::size_t body = 0; body < 3; ++body) map.places.push_back((body + static_cast<std::size_t>(turn)) % 3);
    map.places.push_back(3);
    maps.push_back(map);
  }
  const Exchange ring(maps);
  BOOST_TEST((ring.originals() == std::vector<std::size_t>{0, 0, 0, 3}));
  BOOST_TEST(ring.n_originals(4) == 2U);
  BOOST_TEST(ring.fold() == 3);
  BOOST_TEST(ring.image(2).map.turn == 2);
  // The action of 2 on 0 is that of its original 0 on 1; its action on 3 is that of 0 on 3.
  BOOST_TEST(ring.preimage(2, 0) == 1U);
  BOOST_TEST(ring.preimage(2, 3) == 3U);
}

BOOST_AUTO_TEST_SUITE_END()
