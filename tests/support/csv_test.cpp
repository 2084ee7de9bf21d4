#include "bie/support/csv.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(csv)

BOOST_AUTO_TEST_CASE(cells_are_quoted_only_where_they_must_be) {
  BOOST_TEST(vehd::csv_line({"time", "1.5", ""}) == "time,1.5,\n");
  BOOST_TEST(vehd::csv_line({"a, b", "say \"no\"", "two\nlines"}) == "\"a, b\",\"say \"\"no\"\"\",\"two\nlines\"\n");
}

BOOST_AUTO_TEST_CASE(numbers_and_names_come_back) {
  const std::vector<std::string> cells{"time", "-1e-300", "", "nan"};
  std::string line = vehd::csv_line(cells);
  line.back() = '\r';
  BOOST_TEST(vehd::csv_cells(line) == cells, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
