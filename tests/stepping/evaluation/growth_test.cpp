#include "bie/stepping/evaluation/growth.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/stepping/evaluation/wrinkling.hpp"
#include "bie/stepping/thresholds.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kCompressedOrder = 12;

/// A field that flattens a prolate, as Figure 3 of the paper has it.
Model compressed() {
  Model model = field_model();
  model.vesicles[0].bending = BendingParameters{0.01};
  return model;
}

struct CompressedStart {
  Discretisation discretisation = discretisation_of(kCompressedOrder);
  State state;
  Evaluation evaluation;

  explicit CompressedStart(const Model& model, const Matrix& position = prolate(kCompressedOrder))
      : state(start(model, discretisation, position, 0.1)) {
    Instruments instruments;
    evaluation = evaluate(model, discretisation, state, instruments);
  }
  [[nodiscard]] double growth(const Model& model, double until, int highest_degree = 64) const {
    return expected_growth(model, discretisation, state, evaluation, until, highest_degree);
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(growth)

BOOST_AUTO_TEST_CASE(errors_of_a_compressed_membrane_grow_at_the_rate_of_its_wrinkles) {
  const Model model = compressed();
  const CompressedStart found(model);
  const VesicleDiagnostics& now = found.evaluation.diagnostics.vesicles[0];
  const double radius = std::sqrt(found.state.vesicles[0].reference_area / (4.0 * std::numbers::pi));
  const double rate = wrinkling_rate(flow_parameters(model, model.vesicles[0]), now.tension_integral / now.area, radius,
                                     kCompressedOrder);
  BOOST_TEST(rate > 0.3);
  for (const double time : {0.1, 1.0}) {
    BOOST_TEST(found.growth(model, time) == std::exp(rate * time), boost::test_tools::tolerance(1e-12));
  }
  BOOST_TEST(found.growth(model, 20.0) == thresholds::most_growth, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(found.growth(model, std::numeric_limits<double>::infinity()) == thresholds::most_growth,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(found.growth(model, 0.0) == 1.0);
}

BOOST_AUTO_TEST_CASE(nothing_grows_on_membranes_that_are_stretched_or_frozen) {
  Model stretched = relaxation_model(0.1);
  stretched.flow = axisymmetric_extension(10.0);
  BOOST_TEST(CompressedStart(stretched).growth(stretched, 1e3) == 1.0);
  Model frozen = compressed();
  frozen.mobile = false;
  BOOST_TEST(CompressedStart(frozen).growth(frozen, 1e3) == 1.0);
}

BOOST_AUTO_TEST_CASE(of_wrinkles_finer_than_every_degree_nothing_is_expected) {
  const Model model = compressed();
  const CompressedStart found(model);
  const double finest = found.evaluation.diagnostics.vesicles[0].wrinkle_degree;
  BOOST_TEST(found.growth(model, 1.0, static_cast<int>(finest)) == 1.0);
  BOOST_TEST(found.growth(model, 1.0, static_cast<int>(finest) + 1) > 1.3);
}

// The shear that compresses a prolate along its axis at first soon has it turned.
BOOST_AUTO_TEST_CASE(compression_lasts_until_the_shape_has_changed) {
  const Model model = shear_model();
  const CompressedStart found(model, ellipsoid(kCompressedOrder, {2.0, 1.0, 1.0}));
  const double growth = found.growth(model, 1e6);
  BOOST_TEST(growth > 1.0);
  BOOST_TEST(growth < 1.2);
}

BOOST_AUTO_TEST_SUITE_END()
