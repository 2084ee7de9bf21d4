#include "bie/support/csv.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(csv)

BOOST_AUTO_TEST_CASE(cells_are_quoted_only_where_they_must_be) {
  BOOST_TEST(vehd::csv_line({"time", "1.5", ""}) == "time,1.5,\n");
  BOOST_TEST(vehd::csv_line({"a, b", "say \"no\"", "two\nlines"}) == "\"a, b\",\"say \"\"no\"\"\",\"two\nlines\"\n");
}

BOOST_AUTO_TEST_CASE(numbers_and_names_come_back) {
  const std::vector<std::string> cells{"time", "-1e-300", "", "nan", "a, b", "say \"no\""};
  std::string line = vehd::csv_line(cells);
  line.back() = '\r';
  BOOST_TEST(vehd::csv_cells(line) == cells, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_table_has_the_lines_of_its_file) {
  const TemporaryDirectory directory;
  write_text(directory / "some.csv", "# measured\n\ntime [ms], \"a, b\"\r\n\n 1 ,x\r\n");
  const vehd::CsvTable table(directory / "some.csv");
  BOOST_TEST(table.names() == (std::vector<std::string>{"time", "a, b"}), boost::test_tools::per_element());
  BOOST_TEST(table.unit(0) == "ms");
  BOOST_TEST(table.n_rows() == 1U);
  BOOST_TEST(table.number(0, 0) == 1.0);
  BOOST_TEST(table.text(0, 1) == "x");
  BOOST_TEST(table.header_place() == directory / "some.csv:3");
  BOOST_TEST(table.place(0) == directory / "some.csv:5");
  // Spreadsheets begin files with a byte order mark.
  write_text(directory / "some.csv", "\xEF\xBB\xBFtime,time\n1,2\n");
  BOOST_TEST(vehd::CsvTable(directory / "some.csv").names().front() == "time");
  // As the table of failures of a bench without any.
  write_text(directory / "some.csv", "");
  BOOST_TEST(vehd::CsvTable(directory / "some.csv").n_rows() == 0U);
}

BOOST_AUTO_TEST_SUITE_END()
