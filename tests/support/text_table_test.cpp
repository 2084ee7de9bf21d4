#include "bie/support/text_table.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(text_table)

BOOST_AUTO_TEST_CASE(columns_are_aligned_by_visible_characters) {
  // γ̇ is two characters and four bytes in one column.
  BOOST_TEST(vehd::aligned({{"a", "b", "c"}, {"κ_B", "", "d"}, {"γ̇", "long", "e"}, {"x", "y", ""}}, " ") ==
             " a    b     c\n"
             " κ_B        d\n"
             " γ̇    long  e\n"
             " x    y\n");
}

BOOST_AUTO_TEST_CASE(markdown_escapes_bars_and_marks_the_first_column_as_code) {
  BOOST_TEST(vehd::markdown_table({{"key", "meaning"}, {"modes", "Y_n^|m|"}}) ==
             "| key | meaning |\n| --- | --- |\n| `modes` | Y_n^\\|m\\| |\n");
}

BOOST_AUTO_TEST_SUITE_END()
