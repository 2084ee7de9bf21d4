#include "bie/sphere/small_product.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(small_products)

BOOST_AUTO_TEST_CASE(they_are_products_of_any_shape) {
  for (const Index rows : {1, 2, 3, 4, 5, 6, 7, 8, 9, 17, 23}) {
    for (const Index inner : {0, 1, 2, 17}) {
      for (const Index columns : {4, 8, 12, 16, 20, 24, 28, 36, 48, 52}) {
        const RowMatrix a = RowMatrix::Random(rows, inner), b = RowMatrix::Random(inner, columns);
        const RowMatrix expected = a * b;
        // Rows of a larger matrix; what stands beside the product is left alone.
        RowMatrix wide = RowMatrix::Zero(2 * inner, columns + 3), c = RowMatrix::Constant(rows, columns + 5, 7.0);
        for (Index k = 0; k < inner; ++k) wide.row(2 * k).head(columns) = b.row(k);
        small_product(rows, inner, columns, {a.data(), inner, 1}, wide.data(), 2 * wide.cols(), c.data(), c.cols());
        BOOST_TEST(max_difference(c.leftCols(columns), expected) < 1e-13);
        BOOST_TEST((c.rightCols(5).array() == 7.0).all());
        const RowMatrix turned = a.transpose();
        small_product(rows, inner, columns, {turned.data(), 1, rows}, wide.data(), 2 * wide.cols(), c.data(), c.cols());
        BOOST_TEST(max_difference(c.leftCols(columns), expected) < 1e-13);
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
