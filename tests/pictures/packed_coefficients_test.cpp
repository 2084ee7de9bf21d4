#include "bie/pictures/report/packed_coefficients.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <string>

namespace {

std::string base64_of(const std::string& text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  return vehd::base64(bytes);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(packed_coefficients)

// The test vectors of RFC 4648.
BOOST_AUTO_TEST_CASE(bytes_become_base64_with_padding) {
  BOOST_TEST(base64_of("") == "");
  BOOST_TEST(base64_of("f") == "Zg==");
  BOOST_TEST(base64_of("fo") == "Zm8=");
  BOOST_TEST(base64_of("foo") == "Zm9v");
  BOOST_TEST(base64_of("foob") == "Zm9vYg==");
  BOOST_TEST(vehd::base64(std::array<std::uint8_t, 3>{0xfb, 0xef, 0xff}) == "++//");
}

BOOST_AUTO_TEST_CASE(numbers_are_parts_of_the_largest_of_their_component_and_time) {
  vehd::Matrix coefficients(4, 2);
  coefficients << 2.0, 0.0, -1.0, 0.0, 0.0, 0.0, 2.0 / 32767.0, 0.0;
  vehd::PackedCoefficients packed;
  packed.add(coefficients);
  const nlohmann::json json = packed.json();
  BOOST_TEST(json["scale"] == nlohmann::json::parse("[[2.0, 0.0]]"));
  // 32767, −16384 (−16383.5 is rounded away from zero), 0, 1 and four zeros, low bytes first.
  const std::array<std::uint8_t, 16> bytes{0xff, 0x7f, 0x00, 0xc0, 0x00, 0x00, 0x01, 0x00};
  BOOST_TEST(json["data"] == vehd::base64(bytes));
  BOOST_TEST(vehd::packed_bytes(1) == 4 * 2 * 4 / 3);
}

BOOST_AUTO_TEST_CASE(infinities_and_nan_are_null) {
  BOOST_TEST(vehd::rounded_for_page(1.0 / 3.0).dump() == "0.333333");
  BOOST_TEST(vehd::rounded_for_page(std::nan("")).is_null());
  BOOST_TEST(vehd::rounded_for_page(std::numeric_limits<double>::infinity()).is_null());
}

BOOST_AUTO_TEST_SUITE_END()
