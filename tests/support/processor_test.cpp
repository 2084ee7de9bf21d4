#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <iterator>
#include <string>

#include "bie/support/processor/features.hpp"

namespace {

bool built_for(const std::string& feature) {
  const std::string names[] = {
#define FEATURE(name, macro) name,
#include "bie/support/processor/features.def"
  };
  const auto found = std::find(std::begin(names), std::end(names), feature);
  BOOST_TEST_REQUIRE((found != std::end(names)), feature);
  return vehd::processor::built_for[found - std::begin(names)];
}

}  // namespace

BOOST_AUTO_TEST_SUITE(processor)

BOOST_AUTO_TEST_CASE(the_program_knows_the_instructions_that_the_compiler_could_use) {
#ifdef __AVX2__
  BOOST_TEST(built_for("avx2"));
#else
  BOOST_TEST(!built_for("avx2"));
#endif
#ifdef __AVX512F__
  BOOST_TEST(built_for("avx512f"));
#else
  BOOST_TEST(!built_for("avx512f"));
#endif
}

BOOST_AUTO_TEST_SUITE_END()
