#include "bie/pictures/gnuplot.hpp"

#include <boost/test/unit_test.hpp>
#include <random>
#include <string>

#include "bie/pictures/page.hpp"
#include "bie/support/child_process.hpp"
#include "tests/support/files.hpp"

namespace {

/// Bytes that gnuplot reads from a quoted text.
std::string read_back(const std::string& text) {
  const TemporaryDirectory directory;
  vehd::draw_with_gnuplot("set print 'picture'\nprint " + vehd::gnuplot_quoted(text) + "\n",
                          {directory / "answer", vehd::PictureFormat::png});
  const std::string answer = file_text(directory / "answer");
  BOOST_TEST_REQUIRE(!answer.empty());
  return answer.substr(0, answer.size() - 1);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(gnuplot)

BOOST_AUTO_TEST_CASE(a_quoted_text_is_read_back_byte_for_byte) {
  std::string all;
  for (int byte = 1; byte < 256; ++byte) all += static_cast<char>(byte);
  BOOST_TEST((read_back(all) == all));
  BOOST_TEST((read_back("µ \"'`date` \\ \n!touch pwned\n$(date) @x {/:Bold a}") ==
              "µ \"'`date` \\ \n!touch pwned\n$(date) @x {/:Bold a}"));
  std::mt19937 random(50);
  std::uniform_int_distribution<int> byte(1, 255), length(1, 40);
  for (int trial = 0; trial < 20; ++trial) {
    std::string text;
    for (int left = length(random); left > 0; --left) text += static_cast<char>(byte(random));
    BOOST_TEST((read_back(text) == text));
  }
}

/// Texts of all elements of a picture, as an XML reader finds them.
std::string texts_of_svg(const std::string& file) {
  const TemporaryDirectory directory;
  const vehd::ChildEnd end = vehd::run_child({{"python3", "-c",
                                               "import sys, xml.etree.ElementTree as tree\n"
                                               "print(''.join(tree.parse(sys.argv[1]).getroot().itertext()))",
                                               file},
                                              directory / "texts"});
  BOOST_TEST(end.exit_code == 0, file_text(directory / "texts"));
  return file_text(directory / "texts");
}

BOOST_AUTO_TEST_CASE(a_name_is_drawn_as_it_is_written) {
  const TemporaryDirectory directory;
  const std::string name = "a_b^c{d}@e&f~g\\h`i$j'k\"l<m>ü";
  vehd::Page page{.width = 300.0, .height = 100.0};
  page.texts.push_back({vehd::gnuplot_literal(name), {10.0, 50.0}, 8.0});
  vehd::draw_page(page, {directory / "name.svg", vehd::PictureFormat::svg});
  BOOST_TEST(texts_of_svg(directory / "name.svg").find(name) != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
