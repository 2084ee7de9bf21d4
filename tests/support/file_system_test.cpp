#include "bie/support/file_system.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(file_system)

BOOST_AUTO_TEST_CASE(files_change_places_and_nothing_else_is_left) {
  for (const auto exchange : {vehd::exchange_files, vehd::exchange_by_renames}) {
    const TemporaryDirectory directory;
    write_text(directory / "current", "new");
    write_text(directory / "spare", "old");
    exchange(directory / "current", directory / "spare");
    BOOST_TEST(file_text(directory / "current") == "old");
    BOOST_TEST(file_text(directory / "spare") == "new");
    BOOST_TEST(!std::filesystem::exists(vehd::link_of(directory / "current")));
  }
}

BOOST_AUTO_TEST_CASE(exchange_with_a_missing_file_leaves_the_other) {
  const TemporaryDirectory directory;
  write_text(directory / "current", "new");
  BOOST_CHECK_THROW(vehd::exchange_files(directory / "current", directory / "spare"), vehd::OutputError);
  BOOST_TEST(file_text(directory / "current") == "new");
}

BOOST_AUTO_TEST_SUITE_END()
