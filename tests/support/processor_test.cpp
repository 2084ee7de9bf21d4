#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "bie/support/processor/features.hpp"

namespace {

using Names = std::vector<std::string>;

Names missing(const Names& needed, const Names& present) {
  const auto list = [](const Names& names) {
    std::vector<const char*> pointers;
    for (const std::string& name : names) pointers.push_back(name.c_str());
    pointers.push_back(nullptr);
    return pointers;
  };
  std::vector<const char*> result(needed.size() + 1, "not written");
  const std::size_t count = vehd::processor::find_missing(list(needed).data(), list(present).data(), result.data());
  BOOST_TEST_REQUIRE(count <= needed.size());
  BOOST_TEST(result[count] == nullptr);
  return {result.begin(), result.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(processor)

BOOST_AUTO_TEST_CASE(what_is_needed_and_not_there_is_named_in_order) {
  const Names all{"avx", "avx2", "avx512f"}, none;
  BOOST_TEST(missing(all, all) == none, boost::test_tools::per_element());
  BOOST_TEST(missing(none, none) == none, boost::test_tools::per_element());
  BOOST_TEST(missing(none, all) == none, boost::test_tools::per_element());
  BOOST_TEST(missing(all, none) == all, boost::test_tools::per_element());
  BOOST_TEST(missing(all, {"avx2"}) == (Names{"avx", "avx512f"}), boost::test_tools::per_element());
  // A name that is a prefix of another does not match it.
  BOOST_TEST(missing({"avx"}, {"avx512f", "avx2"}) == Names{"avx"}, boost::test_tools::per_element());
  BOOST_TEST(missing({"avx512f"}, {"avx"}) == Names{"avx512f"}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_program_names_what_the_compiler_was_allowed_to_use) {
  Names names;
  for (const char* const* name = vehd::processor::built_for; *name != nullptr; ++name) names.emplace_back(*name);
  const auto has = [&](const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); };
#ifdef __AVX2__
  BOOST_TEST(has("avx2"));
#else
  BOOST_TEST(!has("avx2"));
#endif
#ifdef __AVX512F__
  BOOST_TEST(has("avx512f"));
#else
  BOOST_TEST(!has("avx512f"));
#endif
}

BOOST_AUTO_TEST_SUITE_END()
