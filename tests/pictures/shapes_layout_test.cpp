#include "bie/pictures/shapes_layout.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <string>
#include <utility>
#include <vector>

using namespace vehd;

namespace {

/// Every part that takes room, with a name for messages.
std::vector<std::pair<std::string, Box>> parts_of(const ShapesLayout& layout, double label_width) {
  std::vector<std::pair<std::string, Box>> parts;
  for (const Box& cell : layout.cells) parts.emplace_back("shape", cell);
  for (const auto& [x, y] : layout.labels) {
    parts.emplace_back("time", Box{x - 0.5 * label_width, y - 0.5 * shape_label_height, x + 0.5 * label_width,
                                   y + 0.5 * shape_label_height});
  }
  for (const Box& item : layout.key) parts.emplace_back("key", item);
  if (layout.bar.width() > 0.0) parts.emplace_back("bar", layout.bar);
  return parts;
}

/// The part without a margin for rounding errors.
Box shrunk(const Box& box) { return {box.left + 1e-6, box.bottom + 1e-6, box.right - 1e-6, box.top - 1e-6}; }

}  // namespace

BOOST_AUTO_TEST_SUITE(shapes_layout)

BOOST_AUTO_TEST_CASE(no_part_meets_another_or_leaves_the_page) {
  const std::vector<std::vector<double>> keys = {
      {}, {50.0, 26.0}, {50.0, 46.0, 62.0, 26.0}, {50.0, 46.0, 46.0, 62.0, 26.0}};
  for (std::size_t n_shapes = 1; n_shapes <= 6; ++n_shapes) {
    for (const auto& [half_width, half_height] :
         {std::pair{1.0, 1.0}, {5.0, 1.0}, {1.0, 5.0}, {1e-6, 1.2e-6}, {20.0, 0.1}}) {
      for (const double label_width : {20.0, 95.0}) {
        for (const double bar_width : {0.0, 45.0}) {
          for (const auto& key : keys) {
            for (const double page_width : {300.0, 510.0}) {
              // Shapes become lower and wider, as they do in a field.
              std::vector<std::array<double, 2>> extents;
              for (std::size_t i = 0; i < n_shapes; ++i) {
                const double change = 1.0 + 0.2 * static_cast<double>(i);
                extents.push_back({half_width * change, half_height / change});
              }
              const ShapesLayout layout = layout_of({extents, label_width, key, 60.0, bar_width, page_width});
              BOOST_TEST_CONTEXT(n_shapes << " shapes of " << half_width << " x " << half_height << ", labels of "
                                          << label_width << ", bar " << bar_width << ", key of " << key.size()
                                          << ", page " << page_width) {
                BOOST_TEST(layout.cells.size() == n_shapes);
                BOOST_TEST(layout.key.size() == key.size());
                const auto parts = parts_of(layout, label_width);
                for (std::size_t i = 0; i < parts.size(); ++i) {
                  const Box box = shrunk(parts[i].second);
                  BOOST_TEST((Box{0.0, 0.0, layout.width, layout.height}.holds(box)), parts[i].first);
                  for (std::size_t k = 0; k < i; ++k) {
                    BOOST_TEST(!box.meets(shrunk(parts[k].second)), parts[i].first + " meets " + parts[k].first);
                  }
                }
                for (std::size_t i = 0; i < n_shapes; ++i) {
                  BOOST_TEST(layout.cells[i].width() >= 2.0 * extents[i][0] * layout.scale - 1.0);
                  BOOST_TEST(layout.cells[i].height() >= 2.0 * extents[i][1] * layout.scale - 1.0);
                }
              }
            }
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_page_is_as_wide_as_it_may_be_at_most) {
  for (std::size_t n_shapes = 1; n_shapes <= 6; ++n_shapes) {
    const std::vector<std::array<double, 2>> extents(n_shapes, {2.0, 1.0});
    const ShapesLayout layout = layout_of({extents, 40.0, {50.0, 46.0, 26.0}, 60.0, 45.0, 510.0});
    BOOST_TEST(layout.width <= 511.0);
    // Shapes, not white space, fill the page.
    BOOST_TEST(layout.cells.front().width() * static_cast<double>(n_shapes) > 0.2 * layout.width);
  }
}

BOOST_AUTO_TEST_SUITE_END()
