#include "bie/sphere/fourier.hpp"

#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace vehd;

namespace {

struct Case {
  int n_phi, order, rows;
};

/// Lengths with and without a centre of the quarter circle, and with a large prime factor.
constexpr Case kCases[] = {{4, 1, 5},   {6, 2, 3},    {10, 4, 1},   {18, 8, 7},    {24, 9, 6},   {34, 16, 17},
                           {66, 16, 5}, {74, 32, 33}, {130, 64, 3}, {260, 64, 18}, {270, 130, 5}};

/// Amplitudes of a mode in a row at [mode * stride + row], with padding between the modes.
Matrix random_amplitudes(const Case& c) {
  std::srand(5);
  return Matrix::Random(c.rows + 2, 2 * c.order + 1);
}

Vector sums_by_definition(const Case& c, const Matrix& amplitudes) {
  Vector values = Vector::Zero(Index{c.rows} * c.n_phi);
  for (int row = 0; row < c.rows; ++row) {
    for (int k = 0; k < c.n_phi; ++k) {
      double& value = values[row * c.n_phi + k];
      value = amplitudes(row, 0);
      for (int m = 1; m <= c.order; ++m) {
        // Reduced by whole periods, so that the argument adds no rounding error.
        const double phase = 2.0 * std::numbers::pi * (m * k % c.n_phi) / c.n_phi;
        value += amplitudes(row, m) * std::cos(phase) + amplitudes(row, c.order + m) * std::sin(phase);
      }
    }
  }
  return values;
}

constexpr double kSynthesis = 1e-12, kAnalysis = 1e-13;

/// Checks synthesis and analysis against the definition and against each other.
void check_fast(const Case& c) {
  const FastFourier method(c.n_phi, c.order);
  const Matrix amplitudes = random_amplitudes(c);
  Vector values = Vector::Constant(Index{c.rows} * c.n_phi, 7.0);
  method.synthesize(c.rows, amplitudes.data(), amplitudes.rows(), values.data());
  BOOST_TEST((values - sums_by_definition(c, amplitudes)).cwiseAbs().maxCoeff() < kSynthesis, c.n_phi);
  Matrix found(2 * c.order + 1, c.rows);
  method.analyze(c.rows, values.data(), found.data());
  BOOST_TEST((found - amplitudes.topRows(c.rows).transpose()).cwiseAbs().maxCoeff() < kAnalysis, c.n_phi);
}

/// Symmetric and antisymmetric parts of random amplitudes on a hemisphere, the equator last.
struct Parts {
  std::array<Matrix, 2> cosines, sines;  ///< symmetric and antisymmetric: [latitudes x orders]

  explicit Parts(const Case& c) {
    const Index n_half = (c.rows + 1) / 2;
    for (auto* of_kind : {&cosines, &sines}) {
      for (Matrix& part : *of_kind) part = Matrix::Random(n_half + 1, c.order + 1);
    }
    if (c.rows % 2 == 0) return;
    cosines[1].row(n_half - 1).setZero();
    sines[1].row(n_half - 1).setZero();
  }

  /// Amplitudes at all latitudes, in the layout of random_amplitudes.
  [[nodiscard]] Matrix together(const Case& c, double sign_of_sines) const {
    Matrix all(c.rows, 2 * c.order + 1);
    for (Index i = (c.rows + 1) / 2 - 1; i >= 0; --i) {
      for (const double sign : {-1.0, 1.0}) {
        const Index row = sign > 0.0 ? i : c.rows - 1 - i;
        all.row(row).head(c.order + 1) = cosines[0].row(i) + sign * cosines[1].row(i);
        all.row(row).tail(c.order) = sign_of_sines * (sines[0].row(i) + sign * sines[1].row(i)).tail(c.order);
      }
    }
    return all;
  }
};

/// One computed amplitude.
double found_amplitude(const FourierSums& method, const AnalysedAmplitudes& found, int part, int m, bool sine,
                       Index i) {
  return found.data[AnalysedAmplitudes::number(part, m, sine) * found.block + i * method.row_length() + m / 2];
}

void check_hemispheres(const Case& c, bool minus_sines) {
  const FourierSums method(c.n_phi, c.order);
  const Parts parts(c);
  const HemisphereAmplitudes amplitudes{{parts.cosines[0].data(), parts.cosines[1].data()},
                                        {parts.sines[0].data(), parts.sines[1].data()},
                                        parts.cosines[0].rows(),
                                        minus_sines};
  Vector values = Vector::Constant(Index{c.rows} * c.n_phi, 7.0);
  method.synthesize(c.rows, amplitudes, values.data());
  const double sign_of_sines = minus_sines ? -1.0 : 1.0;
  const Vector expected = sums_by_definition(c, parts.together(c, sign_of_sines));
  BOOST_TEST((values - expected).cwiseAbs().maxCoeff() < kSynthesis, c.n_phi);

  const Index n_half = (c.rows + 1) / 2, block = n_half * method.row_length() + 3;
  std::vector<double> data(static_cast<std::size_t>(AnalysedAmplitudes::kBlocks * block), 7.0);
  const AnalysedAmplitudes found{data.data(), block};
  method.analyze(c.rows, values.data(), found);
  double error = 0.0;
  for (Index i = 0; i < n_half; ++i) {
    const bool equator = 2 * i == c.rows - 1;
    for (const int part : {0, 1}) {
      // At the equator both parts equal the amplitudes of that latitude.
      const int from = equator ? 0 : part;
      const double times = equator ? 1.0 : 2.0;
      for (int m = 0; m <= c.order; ++m) {
        const double cosine = times * parts.cosines[from](i, m), sine = times * sign_of_sines * parts.sines[from](i, m);
        error = std::max(error, std::abs(found_amplitude(method, found, part, m, false, i) - cosine));
        if (m > 0) error = std::max(error, std::abs(found_amplitude(method, found, part, m, true, i) - sine));
      }
    }
  }
  BOOST_TEST(error < 2.0 * kAnalysis, c.n_phi);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(fourier)

BOOST_AUTO_TEST_CASE(products_over_a_quarter_are_the_sums) {
  for (const Case& c : kCases) {
    for (const bool minus_sines : {false, true}) check_hemispheres(c, minus_sines);
  }
}

BOOST_AUTO_TEST_CASE(fast_transforms_are_the_same_sums) {
  for (const Case& c : kCases) check_fast(c);
}

BOOST_AUTO_TEST_SUITE_END()
