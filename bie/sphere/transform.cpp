#include "bie/sphere/transform.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "bie/sphere/fourier.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/legendre.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Kinds of values: f, d1, d2, d11, d12, d22. For each, whether ∂/∂φ exchanges cosine and sine, and whether ∂/∂θ
/// exchanges symmetric and antisymmetric about the equator.
constexpr int kKinds = 6;
constexpr std::array<bool, kKinds> kPhiDerivative{false, false, true, false, true, false};
constexpr std::array<bool, kKinds> kThetaDerivative{false, true, false, false, true, false};

/// A range of kinds, `end` excluded.
struct Kinds {
  int first, end;
  [[nodiscard]] int count() const { return end - first; }
};

/// Grid values below which waking a second thread costs more than it saves.
constexpr Index kParallelValues = 200000;

}  // namespace

/// Harmonics at θ and π − θ differ only in sign, so the tables hold one hemisphere, with n + m even and odd separate.
struct SphereTransform::Tables {
  int order;
  int azimuthal_order;
  SphereGrid grid;
  FourierSums fourier;
  Index n_half;  ///< latitudes of a hemisphere, the equator among them
  /// Per m and parity of n + m the tables of value, d1, d2, d11, d12, d22 side by side: [degrees x 6 n_half], padded
  /// with zeros so that a range of kinds from any one on fills registers.
  std::vector<std::array<RowMatrix, 2>> synthesis;
  /// Per m and parity of n + m the value times Gauss weight and ∫cos² mφ dφ: [n_half x degrees filled up].
  std::vector<std::array<RowMatrix, 2>> analysis;

  Tables(int order_, SphereGrid grid_, int azimuthal_order_)
      : order(order_),
        azimuthal_order(azimuthal_order_),
        grid(std::move(grid_)),
        fourier(grid.n_phi, azimuthal_order),
        n_half((grid.n_theta + 1) / 2),
        synthesis(azimuthal_order + 1),
        analysis(azimuthal_order + 1) {
    const LegendreTables legendre = legendre_tables(order, grid.theta.head(n_half));
    // FourierSums gives amplitudes, not integrals: ∫ 1 dφ is n_phi spacings, ∫ cos² mφ dφ half of that.
    Vector weight = grid.weight.head(n_half);
    for (int m = 0; m <= azimuthal_order; ++m) {
      const double circle = grid.n_phi * (m == 0 ? 1.0 : 0.5);
      for (const int parity : {0, 1}) {
        const Index count = n_degrees(m, parity);
        RowMatrix& table = synthesis[m][parity];
        RowMatrix& adjoint = analysis[m][parity];
        table = RowMatrix::Zero(count, whole_registers(kKinds * n_half) + whole_registers(1));
        adjoint = RowMatrix::Zero(n_half, whole_registers(count));
        for (Index i = 0; i < count; ++i) {
          const Index column = parity + 2 * i;
          const double n = static_cast<double>(m + column);
          const auto put = [&](int kind, const Vector& values) {
            table.row(i).segment(kind * n_half, n_half) = values.transpose();
          };
          const Vector value = legendre.value[m].col(column), d11 = legendre.d2_theta[m].col(column);
          put(0, value);
          put(1, legendre.d_theta[m].col(column));
          put(2, legendre.m_over_sin[m].col(column));
          put(3, d11);
          put(4, legendre.d_m_over_sin[m].col(column));
          // The Hessian's trace is the Laplacian, −n(n+1) T.
          put(5, -n * (n + 1.0) * value - d11);
          adjoint.col(i) = circle * weight.cwiseProduct(value);
        }
      }
    }
  }

  /// Degrees m + parity, m + parity + 2, … up to the order.
  [[nodiscard]] Index n_degrees(int m, int parity) const { return (order - m - parity + 2) / 2; }
  [[nodiscard]] bool is_parallel(Index n_values) const { return n_values > kParallelValues; }
  [[nodiscard]] std::vector<Matrix> run(const Matrix& coefficients, const Kinds& kinds) const;
  [[nodiscard]] Matrix analyze(const Matrix& values) const;

 private:
  /// Amplitudes of all orders one after another, per parity of n + m: [cosines of all fields, then sines x width].
  struct DegreeSums {
    Index width;   ///< of a row: the kinds side by side on a hemisphere, filled up
    Index stride;  ///< from one order to the next
    std::unique_ptr<double[]> data;

    [[nodiscard]] double* of(int m, int parity) const { return data.get() + m * stride + parity * (stride / 2); }
  };
  [[nodiscard]] DegreeSums degree_sums(Index n_fields, const Kinds& kinds) const;
  /// @param gathered  workspace for the coefficients of one order
  void sum_degrees(const Matrix& coefficients, const Kinds& kinds, int m, double* gathered,
                   const DegreeSums& sums) const;
  /// Values of one kind of one field. @param place  index of the kind within the range
  void sum_orders(const DegreeSums& sums, Index n_fields, Index field, int kind, Index place, double* values) const;
  /// AnalysedAmplitudes of all fields, one after another in every block.
  struct OrderAmplitudes {
    Index of_field;
    Index block;
    std::unique_ptr<double[]> data;
  };
  /// Coefficients of one m. @param sums  workspace for as many, filled up
  void find_degrees(const OrderAmplitudes& amplitudes, int m, double* sums, Matrix& coefficients) const;
};

SphereTransform::Tables::DegreeSums SphereTransform::Tables::degree_sums(Index n_fields, const Kinds& kinds) const {
  const Index width = whole_registers(kinds.count() * n_half), stride = 2 * 2 * n_fields * width;
  return {width, stride, std::make_unique_for_overwrite<double[]>((azimuthal_order + 1) * stride)};
}

void SphereTransform::Tables::sum_degrees(const Matrix& coefficients, const Kinds& kinds, int m, double* gathered,
                                          const DegreeSums& sums) const {
  const Index n_fields = coefficients.cols();
  for (const int parity : {0, 1}) {
    const Index count = n_degrees(m, parity);
    if (count == 0) {
      // The table is empty and has no address.
      std::fill_n(sums.of(m, parity), sums.stride / 2, 0.0);
      continue;
    }
    for (Index field = 0; field < n_fields; ++field) {
      const double* from = coefficients.col(field).data();
      double *cosine = gathered + field * count, *sine = gathered + (n_fields + field) * count;
      for (Index i = 0; i < count; ++i) {
        const int n = m + parity + 2 * static_cast<int>(i);
        cosine[i] = from[coefficient_index(n, m)];
        sine[i] = m > 0 ? from[coefficient_index(n, -m)] : 0.0;
      }
    }
    const RowMatrix& table = synthesis[m][parity];
    small_product(2 * n_fields, count, sums.width, {gathered, count, 1}, table.data() + kinds.first * n_half,
                  table.cols(), sums.of(m, parity), sums.width);
  }
}

void SphereTransform::Tables::sum_orders(const DegreeSums& sums, Index n_fields, Index field, int kind, Index place,
                                         double* values) const {
  HemisphereAmplitudes amplitudes{{}, {}, sums.stride, kPhiDerivative[kind]};
  for (const int parity : {0, 1}) {
    const int part = kThetaDerivative[kind] ? 1 - parity : parity;
    double* cosines = sums.of(0, parity) + field * sums.width + place * n_half;
    double* sines = cosines + n_fields * sums.width;
    // n + m odd means antisymmetric. ∂/∂φ takes cosines to minus sines, sines to cosines.
    amplitudes.cosines[part] = kPhiDerivative[kind] ? sines : cosines;
    amplitudes.sines[part] = kPhiDerivative[kind] ? cosines : sines;
  }
  fourier.synthesize(grid.n_theta, amplitudes, values);
}

std::vector<Matrix> SphereTransform::Tables::run(const Matrix& coefficients, const Kinds& kinds) const {
  require_size("coefficient array", coefficients.rows(), n_coefficients(order));
  const Index n_fields = coefficients.cols();
  std::vector<Matrix> values;
  values.reserve(static_cast<std::size_t>(kinds.count()));
  for (int kind = kinds.first; kind < kinds.end; ++kind) values.emplace_back(grid.n_points(), n_fields);
  const DegreeSums sums = degree_sums(n_fields, kinds);
  const auto gathered_of_one = [&] { return std::make_unique_for_overwrite<double[]>(2 * n_fields * (order / 2 + 1)); };
  const auto put_values = [&](Index i) {
    const Index place = i / n_fields, field = i % n_fields;
    sum_orders(sums, n_fields, field, kinds.first + static_cast<int>(place), place, values[place].col(field).data());
  };
  const Index n_all = kinds.count() * n_fields;
  // Even a team of one thread makes system calls: small transforms avoid OpenMP.
  if (!is_parallel(n_all * grid.n_points())) {
    const auto gathered = gathered_of_one();
    for (int m = 0; m <= azimuthal_order; ++m) sum_degrees(coefficients, kinds, m, gathered.get(), sums);
    for (Index i = 0; i < n_all; ++i) put_values(i);
    return values;
  }
#pragma omp parallel
  {
    const auto gathered = gathered_of_one();
#pragma omp for schedule(dynamic, 1)
    for (int m = 0; m <= azimuthal_order; ++m) sum_degrees(coefficients, kinds, m, gathered.get(), sums);
#pragma omp for schedule(static)
    for (Index i = 0; i < n_all; ++i) put_values(i);
  }
  return values;
}

void SphereTransform::Tables::find_degrees(const OrderAmplitudes& amplitudes, int m, double* sums,
                                           Matrix& coefficients) const {
  const Index n_fields = coefficients.cols(), length = fourier.row_length();
  for (const int parity : {0, 1}) {
    const RowMatrix& table = analysis[m][parity];
    // The block of the sines is the next one.
    const double* first =
        amplitudes.data.get() + AnalysedAmplitudes::number(parity, m, false) * amplitudes.block + m / 2;
    small_product((m == 0 ? 1 : 2) * n_fields, n_half, table.cols(), {first, amplitudes.of_field, length}, table.data(),
                  table.cols(), sums, table.cols());
    for (Index field = 0; field < n_fields; ++field) {
      const double *cosine = sums + field * table.cols(), *sine = sums + (n_fields + field) * table.cols();
      double* to = coefficients.col(field).data();
      for (Index i = 0; i < n_degrees(m, parity); ++i) {
        const int n = m + parity + 2 * static_cast<int>(i);
        to[coefficient_index(n, m)] = cosine[i];
        if (m > 0) to[coefficient_index(n, -m)] = sine[i];
      }
    }
  }
}

Matrix SphereTransform::Tables::analyze(const Matrix& values) const {
  require_size("field on the grid", values.rows(), grid.n_points());
  const Index n_fields = values.cols();
  Matrix coefficients(n_coefficients(order), n_fields);
  if (azimuthal_order < order) coefficients.setZero();
  const Index of_field = n_half * fourier.row_length(), block = n_fields * of_field;
  const OrderAmplitudes amplitudes{of_field, block,
                                   std::make_unique_for_overwrite<double[]>(AnalysedAmplitudes::kBlocks * block)};
  const auto find_orders = [&](Index field) {
    fourier.analyze(grid.n_theta, values.col(field).data(), {amplitudes.data.get() + field * of_field, block});
  };
  const auto sums_of_one = [&] {
    return std::make_unique_for_overwrite<double[]>(2 * n_fields * whole_registers(order / 2 + 1));
  };
  if (!is_parallel(values.size())) {
    const auto sums = sums_of_one();
    for (Index f = 0; f < n_fields; ++f) find_orders(f);
    for (int m = 0; m <= azimuthal_order; ++m) find_degrees(amplitudes, m, sums.get(), coefficients);
    return coefficients;
  }
#pragma omp parallel
  {
    const auto sums = sums_of_one();
#pragma omp for schedule(static)
    for (Index f = 0; f < n_fields; ++f) find_orders(f);
#pragma omp for schedule(dynamic, 1)
    for (int m = 0; m <= azimuthal_order; ++m) find_degrees(amplitudes, m, sums.get(), coefficients);
  }
  return coefficients;
}

SphereTransform::SphereTransform(int order, SphereGrid grid) : SphereTransform(order, std::move(grid), order) {}

SphereTransform::SphereTransform(int order, SphereGrid grid, int azimuthal_order) {
  if (grid.order < order || grid.n_phi < 2 * azimuthal_order + 2) {
    throw ShapeError("a grid of order " + std::to_string(grid.order) + " cannot carry harmonics of order " +
                     std::to_string(order));
  }
  tables_ = std::make_shared<const Tables>(order, std::move(grid), azimuthal_order);
}

int SphereTransform::order() const { return tables_->order; }
int SphereTransform::azimuthal_order() const { return tables_->azimuthal_order; }
const SphereGrid& SphereTransform::grid() const { return tables_->grid; }

Matrix SphereTransform::synthesize(const Matrix& coefficients) const {
  return std::move(tables_->run(coefficients, {0, 1})[0]);
}

SphereDerivatives SphereTransform::synthesize_gradient(const Matrix& coefficients) const {
  std::vector<Matrix> v = tables_->run(coefficients, {0, 3});
  return {std::move(v[0]), std::move(v[1]), std::move(v[2]), {}, {}, {}};
}

SphereDerivatives SphereTransform::synthesize_first_derivatives(const Matrix& coefficients) const {
  std::vector<Matrix> v = tables_->run(coefficients, {1, 3});
  return {{}, std::move(v[0]), std::move(v[1]), {}, {}, {}};
}

SphereDerivatives SphereTransform::synthesize_derivatives(const Matrix& coefficients) const {
  std::vector<Matrix> v = tables_->run(coefficients, {1, kKinds});
  return {{}, std::move(v[0]), std::move(v[1]), std::move(v[2]), std::move(v[3]), std::move(v[4])};
}

SphereDerivatives SphereTransform::synthesize_hessian(const Matrix& coefficients) const {
  std::vector<Matrix> v = tables_->run(coefficients, {0, kKinds});
  return {std::move(v[0]), std::move(v[1]), std::move(v[2]), std::move(v[3]), std::move(v[4]), std::move(v[5])};
}

Matrix SphereTransform::analyze(const Matrix& values) const { return tables_->analyze(values); }

}  // namespace vehd
