#include "bie/sphere/transform.hpp"

#include <array>
#include <vector>

#include "bie/sphere/fourier.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/legendre.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Which latitude table a derivative needs, and whether ∂/∂φ exchanges cosine and sine.
constexpr int kKinds = 6;
constexpr std::array<bool, kKinds> kPhiDerivative{false, false, true, false, true, false};

/// Grid values below which waking a second thread costs more than it saves.
constexpr Index kParallelValues = 60000;

/// Fields that are analyzed together, so that the sums over latitudes are products of matrices, and columns below which
/// such a product takes longer than one by one.
constexpr Index kTogether = 4, kFewColumns = 3;

}  // namespace

struct SphereTransform::Tables {
  int order;
  int azimuthal_order;
  SphereGrid grid;
  FourierPlan fourier;
  /// Per m the tables of value, d1, d2, d11, d12, d22 stacked: [6 n_theta x (order + 1 − m)].
  std::vector<Matrix> synthesis;
  /// Per m the transposed value table times Gauss weight and φ spacing: [(order + 1 − m) x n_theta].
  std::vector<Matrix> analysis;

  Tables(int order_, SphereGrid grid_, int azimuthal_order_)
      : order(order_),
        azimuthal_order(azimuthal_order_),
        grid(std::move(grid_)),
        fourier(grid.n_theta, grid.n_phi),
        synthesis(azimuthal_order + 1),
        analysis(azimuthal_order + 1) {
    const LegendreTables legendre = legendre_tables(order, grid.theta);
    const Index rows = grid.n_theta;
    for (int m = 0; m <= azimuthal_order; ++m) {
      Matrix& stack = synthesis[m];
      stack.resize(kKinds * rows, order + 1 - m);
      stack.middleRows(0, rows) = legendre.value[m];
      stack.middleRows(rows, rows) = legendre.d_theta[m];
      stack.middleRows(2 * rows, rows) = legendre.m_over_sin[m];
      stack.middleRows(3 * rows, rows) = legendre.d2_theta[m];
      stack.middleRows(4 * rows, rows) = legendre.d_m_over_sin[m];
      for (int n = m; n <= order; ++n) {
        // The Hessian's trace is the Laplacian, −n(n+1) T.
        stack.col(n - m).tail(rows) =
            -(double(n) * (n + 1)) * legendre.value[m].col(n - m) - legendre.d2_theta[m].col(n - m);
      }
      // ∫ cos² mφ dφ is half of ∫ 1 dφ; the amplitudes of FourierPlan are those of the function itself.
      const Vector scaled = grid.weight * (grid.n_phi * (m == 0 ? 1.0 : 0.5));
      analysis[m] = (scaled.asDiagonal() * legendre.value[m]).transpose();
    }
  }

  [[nodiscard]] std::vector<Matrix> run(const Matrix& coefficients, int kinds) const;
};

std::vector<Matrix> SphereTransform::Tables::run(const Matrix& coefficients, int kinds) const {
  require_size("coefficient array", coefficients.rows(), n_coefficients(order));
  const Index n_fields = coefficients.cols();
  const Index n_theta = grid.n_theta;
  const Index n_modes = grid.n_phi / 2 + 1;
  // Spectrum of kind k, field f: columns (k * n_fields + f) * n_modes + m.
  Eigen::MatrixXcd spectrum = Eigen::MatrixXcd::Zero(n_theta, kinds * n_fields * n_modes);
  std::vector<Matrix> values(kinds, Matrix(grid.n_points(), n_fields));

  struct Work {
    Matrix gathered;
    Matrix product;
  };
  const auto sum_degrees = [&](int m, Work& work) {
    const Index columns = (m == 0 ? 1 : 2) * n_fields;
    work.gathered.resize(order + 1 - m, columns);
    for (Index f = 0; f < n_fields; ++f) {
      for (int n = m; n <= order; ++n) {
        work.gathered(n - m, f) = coefficients(coefficient_index(n, m), f);
        if (m > 0) work.gathered(n - m, n_fields + f) = coefficients(coefficient_index(n, -m), f);
      }
    }
    work.product.noalias() = synthesis[m].topRows(kinds * n_theta) * work.gathered;
    for (int kind = 0; kind < kinds; ++kind) {
      for (Index f = 0; f < n_fields; ++f) {
        const Index target = (kind * n_fields + f) * n_modes + m;
        const auto from_cosine = work.product.col(f).segment(kind * n_theta, n_theta);
        if (m == 0) {
          if (!kPhiDerivative[kind]) spectrum.col(target).real() = from_cosine;
          continue;
        }
        const auto from_sine = work.product.col(n_fields + f).segment(kind * n_theta, n_theta);
        if (kPhiDerivative[kind]) {
          spectrum.col(target).real() = from_sine;
          spectrum.col(target).imag() = from_cosine;
        } else {
          spectrum.col(target).real() = from_cosine;
          spectrum.col(target).imag() = -from_sine;
        }
      }
    }
  };
  const auto sum_orders = [&](Index i) {
    fourier.synthesize(spectrum.middleCols(i * n_modes, n_modes), values[i / n_fields].col(i % n_fields).data());
  };

  // Even a team of one makes system calls: small transforms stay out of OpenMP altogether.
  if (kinds * n_fields * grid.n_points() <= kParallelValues) {
    Work work;
    for (int m = 0; m <= azimuthal_order; ++m) sum_degrees(m, work);
    for (Index i = 0; i < kinds * n_fields; ++i) sum_orders(i);
    return values;
  }
#pragma omp parallel
  {
    Work work;
#pragma omp for schedule(dynamic, 1)
    for (int m = 0; m <= azimuthal_order; ++m) sum_degrees(m, work);
#pragma omp for schedule(static)
    for (Index i = 0; i < kinds * n_fields; ++i) sum_orders(i);
  }
  return values;
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
  return std::move(tables_->run(coefficients, 1)[0]);
}

SphereDerivatives SphereTransform::synthesize_gradient(const Matrix& coefficients) const {
  std::vector<Matrix> v = tables_->run(coefficients, 3);
  return {std::move(v[0]), std::move(v[1]), std::move(v[2]), {}, {}, {}};
}

SphereDerivatives SphereTransform::synthesize_hessian(const Matrix& coefficients) const {
  std::vector<Matrix> v = tables_->run(coefficients, kKinds);
  return {std::move(v[0]), std::move(v[1]), std::move(v[2]), std::move(v[3]), std::move(v[4]), std::move(v[5])};
}

Matrix SphereTransform::analyze(const Matrix& values) const {
  const Tables& t = *tables_;
  require_size("field on the grid", values.rows(), t.grid.n_points());
  const Index n_fields = values.cols();
  Matrix coefficients(n_coefficients(t.order), n_fields);
  if (t.azimuthal_order < t.order) coefficients.setZero();
  const auto analyze_fields = [&](Index first) {
    const Index count = std::min(kTogether, n_fields - first);
    std::vector<Eigen::MatrixXcd> spectra;
    for (Index f = 0; f < count; ++f) spectra.push_back(t.fourier.analyze(values.col(first + f).data()));
    Matrix gathered, product;
    for (int m = 0; m <= t.azimuthal_order; ++m) {
      gathered.resize(t.grid.n_theta, m == 0 ? count : 2 * count);
      for (Index f = 0; f < count; ++f) {
        gathered.col(f) = spectra[f].col(m).real();
        if (m > 0) gathered.col(count + f) = -spectra[f].col(m).imag();
      }
      product.resize(t.order + 1 - m, gathered.cols());
      if (gathered.cols() < kFewColumns) {
        for (Index i = 0; i < gathered.cols(); ++i) product.col(i).noalias() = t.analysis[m] * gathered.col(i);
      } else {
        product.noalias() = t.analysis[m] * gathered;
      }
      for (Index f = 0; f < count; ++f) {
        for (int n = m; n <= t.order; ++n) {
          coefficients(coefficient_index(n, m), first + f) = product(n - m, f);
          if (m > 0) coefficients(coefficient_index(n, -m), first + f) = product(n - m, count + f);
        }
      }
    }
  };
  if (values.size() <= kParallelValues) {
    for (Index f = 0; f < n_fields; f += kTogether) analyze_fields(f);
    return coefficients;
  }
#pragma omp parallel for schedule(static)
  for (Index f = 0; f < n_fields; f += kTogether) analyze_fields(f);
  return coefficients;
}

}  // namespace vehd
