#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/layer_operators.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

using Stride = Eigen::OuterStride<>;
using Block = Eigen::Map<RowMatrix, 0, Stride>;
using ConstBlock = Eigen::Map<const RowMatrix, 0, Stride>;

/// Kinds of shape data at the nodes: x, ∂x/∂θ, ∂x/(sin θ ∂φ) in the rotated frame.
constexpr int kShapeKinds = 3;

/// What each column of the assembled rows means.
struct KernelColumns {
  int single = -1, double_layer = -1, adjoint = -1, stokes = -1;
  int count = 0;

  explicit KernelColumns(const LayerSelection& selection) {
    if (selection.laplace_single) single = count++;
    if (selection.laplace_double) double_layer = count++;
    if (selection.laplace_adjoint) adjoint = count++;
    if (selection.stokes_single) {
      stokes = count;
      count += 6;
    }
  }
};

/// Harmonic coefficients of many columns in the rectangular layout [m][n][column], cosines and sines apart: rows of
/// one m are contiguous (Legendre sums), rows of one n have a constant stride (Wigner blocks).
class CoefficientBlock {
 public:
  CoefficientBlock(int order, Index columns)
      : width_(order + 1),
        columns_(columns),
        cosine_(width_ * width_ * columns, 0.0),
        sine_(width_ * width_ * columns, 0.0) {}

  double* row(bool sine, int n, int m) { return (sine ? sine_ : cosine_).data() + (m * width_ + n) * columns_; }
  const double* row(bool sine, int n, int m) const {
    return (sine ? sine_ : cosine_).data() + (m * width_ + n) * columns_;
  }
  /// Degrees m..p of order m.
  Block order_block(bool sine, int m) { return {row(sine, m, m), width_ - m, columns_, Stride(columns_)}; }
  /// Orders first..n of degree n.
  Block degree_block(bool sine, int n, int first) {
    return {row(sine, n, first), n + 1 - first, columns_, Stride(width_ * columns_)};
  }

 private:
  Index width_;
  Index columns_;
  std::vector<double> cosine_;
  std::vector<double> sine_;
};

/// Work of one thread on the targets of one latitude, a chunk of them at a time.
class LatitudeWorker {
 public:
  LatitudeWorker(const RotatedQuadrature& quadrature, const KernelColumns& kernels, const Matrix& position, int chunk)
      : q_(quadrature),
        kernels_(kernels),
        position_(position),
        chunk_(chunk),
        order_(quadrature.order),
        shape_(order_, 3 * chunk),
        rotated_shape_(order_, 3 * chunk),
        rows_(order_, kernels.count * chunk),
        rotated_rows_(order_, kernels.count * chunk),
        shape_kinds_(kernels.double_layer >= 0 ? kShapeKinds : 1) {}

  /// Fills the chunk's rows of `rows`, [n_phi x kernels * n_coefficients], coefficients in order-major order.
  void run(int latitude, const Vector& phi, Index first, const Matrix& target_position,
           const Matrix& target_area_vector, RowMatrix& rows) {
    load_shape(phi, first);
    rotate(latitude, shape_, rotated_shape_, false);
    synthesize_shape();
    evaluate_kernels(target_position, target_area_vector);
    collect_rows();
    rotate(latitude, rotated_rows_, rows_, true);
    store_rows(phi, first, rows);
  }

 private:
  Index row_columns() const { return Index{kernels_.count} * chunk_; }

  /// Coefficients of x(R_z(φ_t) s): a phase shift for every target of the chunk.
  void load_shape(const Vector& phi, Index first) {
    for (int m = 0; m <= order_; ++m) {
      for (int t = 0; t < chunk_; ++t) {
        const double c = std::cos(m * phi[first + t]);
        const double s = std::sin(m * phi[first + t]);
        for (int n = m; n <= order_; ++n) {
          for (int i = 0; i < 3; ++i) {
            const double a = position_(coefficient_index(n, m), i);
            const double b = m > 0 ? position_(coefficient_index(n, -m), i) : 0.0;
            shape_.row(false, n, m)[i * chunk_ + t] = a * c + b * s;
            shape_.row(true, n, m)[i * chunk_ + t] = b * c - a * s;
          }
        }
      }
    }
  }

  void rotate(int latitude, CoefficientBlock& from, CoefficientBlock& to, bool transpose) const {
    const RotationY& rotation = q_.rotations[latitude];
    for (int n = 0; n <= order_; ++n) {
      if (transpose) {
        to.degree_block(false, n, 0).noalias() = rotation.cosine[n].transpose() * from.degree_block(false, n, 0);
        if (n > 0) to.degree_block(true, n, 1).noalias() = rotation.sine[n].transpose() * from.degree_block(true, n, 1);
      } else {
        to.degree_block(false, n, 0).noalias() = rotation.cosine[n] * from.degree_block(false, n, 0);
        if (n > 0) to.degree_block(true, n, 1).noalias() = rotation.sine[n] * from.degree_block(true, n, 1);
      }
    }
  }

  /// Shape data at all nodes of all targets in the chunk, in nodes_[kind]: [quadrant][quarter φ][θ][3][target].
  /// Only the double layer needs the tangents.
  void synthesize_shape() {
    const Index columns = Index{3} * chunk_;
    const Index plane = q_.n_theta * columns;
    const int n_even = order_ / 2 + 1;
    const int n_odd = (order_ + 1) / 2;
    for (int kind = 0; kind < shape_kinds_; ++kind) {
      even_cosine_[kind].resize(n_even, plane);
      even_sine_[kind].resize(n_even, plane);
      odd_cosine_[kind].resize(n_odd, plane);
      odd_sine_[kind].resize(n_odd, plane);
    }
    for (int m = 0; m <= order_; ++m) {
      product_.noalias() = q_.synthesis[m].topRows(shape_kinds_ * q_.n_theta) * rotated_shape_.order_block(false, m);
      product_sine_.noalias() =
          q_.synthesis[m].topRows(shape_kinds_ * q_.n_theta) * rotated_shape_.order_block(true, m);
      for (int kind = 0; kind < shape_kinds_; ++kind) {
        const Eigen::Map<const Eigen::RowVectorXd> from_cosine(product_.data() + kind * plane, plane);
        const Eigen::Map<const Eigen::RowVectorXd> from_sine(product_sine_.data() + kind * plane, plane);
        RowMatrix& cosine = m % 2 == 0 ? even_cosine_[kind] : odd_cosine_[kind];
        RowMatrix& sine = m % 2 == 0 ? even_sine_[kind] : odd_sine_[kind];
        if (kind == 2) {
          cosine.row(m / 2) = from_sine;
          sine.row(m / 2) = -from_cosine;
        } else {
          cosine.row(m / 2) = from_cosine;
          sine.row(m / 2) = from_sine;
        }
      }
    }
    const int quarter = q_.n_phi / 4;
    for (int kind = 0; kind < shape_kinds_; ++kind) {
      ce_.noalias() = q_.cosine_even * even_cosine_[kind];
      se_.noalias() = q_.sine_even * even_sine_[kind];
      co_.noalias() = q_.cosine_odd * odd_cosine_[kind];
      so_.noalias() = q_.sine_odd * odd_sine_[kind];
      RowMatrix& out = nodes_[kind];
      out.resize(4 * quarter, plane);
      // φ, π − φ, π + φ, −φ
      out.middleRows(0, quarter) = (ce_ + co_) + (se_ + so_);
      out.middleRows(quarter, quarter) = (ce_ - co_) - (se_ - so_);
      out.middleRows(2 * quarter, quarter) = (ce_ - co_) + (se_ - so_);
      out.middleRows(3 * quarter, quarter) = (ce_ + co_) - (se_ + so_);
    }
  }

  /// Kernel times weight, in values_: [quadrant][quarter φ][θ][kernel][target].
  void evaluate_kernels(const Matrix& target_position, const Matrix& target_area_vector) {
    const int n_targets = chunk_;
    values_.resize(q_.n_phi, q_.n_theta * row_columns());
    const double* xt = target_position.col(0).data();
    const double* yt = target_position.col(1).data();
    const double* zt = target_position.col(2).data();
    const double* nxt = target_area_vector.col(0).data();
    const double* nyt = target_area_vector.col(1).data();
    const double* nzt = target_area_vector.col(2).data();
    distance_.resize(n_targets, 4);
    double* rx = distance_.col(0).data();
    double* ry = distance_.col(1).data();
    double* rz = distance_.col(2).data();
    double* inverse_r = distance_.col(3).data();
    for (int azimuth = 0; azimuth < q_.n_phi; ++azimuth) {
      for (int i = 0; i < q_.n_theta; ++i) {
        const double* x = nodes_[0].row(azimuth).data() + Index{3} * i * n_targets;
        double* out = values_.row(azimuth).data() + i * row_columns();
        const double laplace_weight = kLaplacePrefactor * q_.weight[i];
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          rx[t] = xt[t] - x[t];
          ry[t] = yt[t] - x[n_targets + t];
          rz[t] = zt[t] - x[2 * n_targets + t];
          inverse_r[t] = 1.0 / std::sqrt(rx[t] * rx[t] + ry[t] * ry[t] + rz[t] * rz[t]);
        }
        if (kernels_.single >= 0) {
          double* single = out + kernels_.single * n_targets;
#pragma omp simd
          for (int t = 0; t < n_targets; ++t) single[t] = laplace_weight * laplace_single_kernel(inverse_r[t]);
        }
        if (kernels_.double_layer >= 0) {
          const double* u = nodes_[1].row(azimuth).data() + Index{3} * i * n_targets;
          const double* v = nodes_[2].row(azimuth).data() + Index{3} * i * n_targets;
          double* double_layer = out + kernels_.double_layer * n_targets;
#pragma omp simd
          for (int t = 0; t < n_targets; ++t) {
            const double ux = u[t], uy = u[n_targets + t], uz = u[2 * n_targets + t];
            const double vx = v[t], vy = v[n_targets + t], vz = v[2 * n_targets + t];
            const double r_dot_area =
                rx[t] * (uy * vz - uz * vy) + ry[t] * (uz * vx - ux * vz) + rz[t] * (ux * vy - uy * vx);
            double_layer[t] = laplace_weight * laplace_double_kernel(r_dot_area, inverse_r[t]);
          }
        }
        if (kernels_.adjoint >= 0) {
          double* adjoint = out + kernels_.adjoint * n_targets;
#pragma omp simd
          for (int t = 0; t < n_targets; ++t) {
            const double r_dot_n = rx[t] * nxt[t] + ry[t] * nyt[t] + rz[t] * nzt[t];
            adjoint[t] = laplace_weight * laplace_adjoint_kernel(r_dot_n, inverse_r[t]);
          }
        }
        if (kernels_.stokes >= 0) {
          double* stokes = out + kernels_.stokes * n_targets;
          const double stokes_weight = stokes_single_layer_prefactor(1.0) * q_.weight[i];
#pragma omp simd
          for (int t = 0; t < n_targets; ++t) {
            const auto g = stokeslet(rx[t], ry[t], rz[t], inverse_r[t]);
            for (int c = 0; c < 6; ++c) stokes[c * n_targets + t] = stokes_weight * g[c];
          }
        }
      }
    }
  }

  /// Adjoint of the synthesis: the weighted kernel values become rows over rotated coefficients.
  void collect_rows() {
    const int quarter = q_.n_phi / 4;
    const auto k1 = values_.middleRows(0, quarter);
    const auto k2 = values_.middleRows(quarter, quarter);
    const auto k3 = values_.middleRows(2 * quarter, quarter);
    const auto k4 = values_.middleRows(3 * quarter, quarter);
    ce_ = (k1 + k4) + (k2 + k3);
    co_ = (k1 + k4) - (k2 + k3);
    se_ = (k1 - k4) - (k2 - k3);
    so_ = (k1 - k4) + (k2 - k3);
    even_cosine_[0].noalias() = q_.cosine_even.transpose() * ce_;
    odd_cosine_[0].noalias() = q_.cosine_odd.transpose() * co_;
    even_sine_[0].noalias() = q_.sine_even.transpose() * se_;
    odd_sine_[0].noalias() = q_.sine_odd.transpose() * so_;
    const Index columns = row_columns();
    for (int m = 0; m <= order_; ++m) {
      const RowMatrix& cosine = m % 2 == 0 ? even_cosine_[0] : odd_cosine_[0];
      const RowMatrix& sine = m % 2 == 0 ? even_sine_[0] : odd_sine_[0];
      const ConstBlock cosine_m(cosine.row(m / 2).data(), q_.n_theta, columns, Stride(columns));
      const ConstBlock sine_m(sine.row(m / 2).data(), q_.n_theta, columns, Stride(columns));
      rotated_rows_.order_block(false, m).noalias() = q_.adjoint[m] * cosine_m;
      rotated_rows_.order_block(true, m).noalias() = q_.adjoint[m] * sine_m;
    }
  }

  /// Undoes the phase shift.
  void store_rows(const Vector& phi, Index first, RowMatrix& rows) const {
    const Index n_kernels = kernels_.count;
    const Index block = n_coefficients(order_);
    const Index stride = row_columns();
    Index offset = 0;
    for (int m = 0; m <= order_; ++m) {
      const Index n_degrees = order_ + 1 - m;
      for (int t = 0; t < chunk_; ++t) {
        const double cosine_phase = std::cos(m * phi[first + t]);
        const double sine_phase = std::sin(m * phi[first + t]);
        double* row = rows.row(first + t).data() + offset;
        for (Index c = 0; c < n_kernels; ++c, row += block) {
          const double* cosine = rows_.row(false, m, m) + c * chunk_ + t;
          const double* sine = rows_.row(true, m, m) + c * chunk_ + t;
          for (Index i = 0; i < n_degrees; ++i) {
            row[i] = cosine[i * stride] * cosine_phase - sine[i * stride] * sine_phase;
          }
          if (m == 0) continue;
          for (Index i = 0; i < n_degrees; ++i) {
            row[n_degrees + i] = cosine[i * stride] * sine_phase + sine[i * stride] * cosine_phase;
          }
        }
      }
      offset += (m == 0 ? 1 : 2) * n_degrees;
    }
  }

  const RotatedQuadrature& q_;
  const KernelColumns& kernels_;
  const Matrix& position_;
  int chunk_;
  int order_;
  CoefficientBlock shape_, rotated_shape_, rows_, rotated_rows_;
  int shape_kinds_;
  RowMatrix product_, product_sine_, ce_, se_, co_, so_, values_;
  RowMatrix even_cosine_[kShapeKinds], even_sine_[kShapeKinds], odd_cosine_[kShapeKinds], odd_sine_[kShapeKinds];
  RowMatrix nodes_[kShapeKinds];
  Matrix distance_;  ///< r and 1/|r| of the targets at one node
};

/// Rows: cos mφ_k for m = 0..p, then sin mφ_k for m = 1..p, scaled so that sums over k give Fourier amplitudes.
RowMatrix fourier_matrix(const SphereGrid& grid) {
  const int order = grid.order;
  RowMatrix fourier(2 * order + 1, grid.n_phi);
  for (int k = 0; k < grid.n_phi; ++k) {
    for (int m = 0; m <= order; ++m) {
      const double scale = (m == 0 ? 1.0 : 2.0) / grid.n_phi;
      fourier(m, k) = scale * std::cos(m * grid.phi[k]);
      if (m > 0) fourier(order + m, k) = scale * std::sin(m * grid.phi[k]);
    }
  }
  return fourier;
}

/// coefficient_index of each entry in order-major order: m = 0, then cosines and sines of m = 1, 2, ...
std::vector<Index> order_major_indices(int order) {
  std::vector<Index> indices;
  for (int m = 0; m <= order; ++m) {
    for (int n = m; n <= order; ++n) indices.push_back(coefficient_index(n, m));
    for (int n = m; n <= order && m > 0; ++n) indices.push_back(coefficient_index(n, -m));
  }
  return indices;
}

/// Targets that share the matrix products: enough columns for efficiency, few enough to stay in cache.
int chunk_size(int n_phi) {
  constexpr int kLargest = 12;
  const int n_chunks = (n_phi + kLargest - 1) / kLargest;
  return (n_phi + n_chunks - 1) / n_chunks;
}

}  // namespace

LayerOperators assemble_layer_operators(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                        const Matrix& position, const LayerSelection& selection,
                                        Instruments& instruments) {
  const int order = quadrature.order;
  require_size("position", position.rows(), n_coefficients(order));
  const SphereGrid& grid = transform.grid();
  require_size("target grid (order)", grid.order, order);
  const KernelColumns kernels(selection);
  if (kernels.count == 0) return {};

  const SphereDerivatives x = transform.synthesize_gradient(position);
  Matrix area_vector(grid.n_points(), 3);  // J n
  for (Index i = 0; i < area_vector.rows(); ++i) {
    area_vector.row(i) = Vector3(x.d1.row(i)).cross(Vector3(x.d2.row(i))).transpose();
  }

  const Index n = n_coefficients(order);
  const Index n_modes = 2 * order + 1;
  const RowMatrix fourier = fourier_matrix(grid);
  const int chunk = chunk_size(grid.n_phi);
  // Per Fourier mode of the target azimuth: [kernels * n_coefficients x latitudes].
  std::vector<Matrix> modes(n_modes, Matrix(kernels.count * n, grid.n_theta));
#pragma omp parallel
  {
    LatitudeWorker worker(quadrature, kernels, position, chunk);
    RowMatrix rows(grid.n_phi, kernels.count * n);
    RowMatrix spectrum;
#pragma omp for schedule(dynamic, 1)
    for (int j = 0; j < grid.n_theta; ++j) {
      for (int done = 0; done < grid.n_phi; done += chunk) {
        // The last chunk reaches back over targets that are done already.
        const int first = std::min(done, grid.n_phi - chunk);
        const Index start = Index{j} * grid.n_phi + first;
        worker.run(j, grid.phi, first, x.value.middleRows(start, chunk), area_vector.middleRows(start, chunk), rows);
      }
      spectrum.noalias() = fourier * rows;
      for (Index mode = 0; mode < n_modes; ++mode) modes[mode].col(j) = spectrum.row(mode);
    }
  }

  std::vector<Matrix> operators(kernels.count, Matrix(n, n));
  const std::vector<Index> indices = order_major_indices(order);
#pragma omp parallel for schedule(dynamic, 1)
  for (Index mode = 0; mode < n_modes; ++mode) {
    const int m = static_cast<int>(mode <= order ? mode : mode - order);
    const Matrix product = modes[mode] * quadrature.target_analysis[m];
    for (int degree = m; degree <= order; ++degree) {
      const Index out = coefficient_index(degree, mode <= order ? m : -m);
      for (int c = 0; c < kernels.count; ++c) {
        const double* from = product.col(degree - m).data() + c * n;
        double* to = operators[c].col(out).data();
        for (Index i = 0; i < n; ++i) to[indices[i]] = from[i];
      }
    }
  }

  const std::uint64_t evaluations = static_cast<std::uint64_t>(grid.n_points()) * quadrature.n_nodes();
  LayerOperators result;
  if (selection.laplace_single) {
    result.laplace_single = ScalarOperator(std::move(operators[kernels.single]));
    instruments.count_kernel("laplace_single", evaluations);
  }
  if (selection.laplace_double) {
    result.laplace_double = ScalarOperator(std::move(operators[kernels.double_layer]));
    instruments.count_kernel("laplace_double", evaluations);
  }
  if (selection.laplace_adjoint) {
    result.laplace_adjoint = ScalarOperator(std::move(operators[kernels.adjoint]));
    instruments.count_kernel("laplace_adjoint", evaluations);
  }
  if (selection.stokes_single) {
    std::array<Matrix, 6> blocks;
    for (int c = 0; c < 6; ++c) blocks[c] = std::move(operators[kernels.stokes + c]);
    result.stokes_single = StokesOperator(std::move(blocks));
    instruments.count_kernel("stokes_single", evaluations);
  }
  return result;
}

}  // namespace vehd
