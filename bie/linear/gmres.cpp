#include "bie/linear/gmres.hpp"

#include <fmt/format.h>

#include <Eigen/Sparse>
#include <cmath>
#include <unsupported/Eigen/IterativeSolvers>

#include "bie/support/errors.hpp"

namespace vehd {

class MatrixFree;

}  // namespace vehd

namespace Eigen::internal {

template <>
struct traits<vehd::MatrixFree> : traits<SparseMatrix<double>> {};

}  // namespace Eigen::internal

namespace vehd {

/// What Eigen's iterative solvers want to see of a matrix-free operator.
class MatrixFree : public Eigen::EigenBase<MatrixFree> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  MatrixFree(const LinearMap& map, Index size) : map_(map), size_(size) {}

  [[nodiscard]] Index rows() const { return size_; }
  [[nodiscard]] Index cols() const { return size_; }

  template <typename Rhs>
  Eigen::Product<MatrixFree, Rhs, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }

  /// The first residual of a zero start needs no application of the map.
  [[nodiscard]] Vector apply(const Vector& x) const { return x.isZero(0.0) ? x : map_(x); }

 private:
  const LinearMap& map_;
  Index size_;
};

namespace {

class MapPreconditioner {
 public:
  void set(const LinearMap& map) { map_ = &map; }
  template <typename MatrixType>
  MapPreconditioner& analyzePattern(const MatrixType&) {
    return *this;
  }
  template <typename MatrixType>
  MapPreconditioner& factorize(const MatrixType&) {
    return *this;
  }
  template <typename MatrixType>
  MapPreconditioner& compute(const MatrixType&) {
    return *this;
  }
  [[nodiscard]] Vector solve(const Vector& x) const { return (*map_)(x); }
  [[nodiscard]] static Eigen::ComputationInfo info() { return Eigen::Success; }

 private:
  const LinearMap* map_ = nullptr;
};

}  // namespace

}  // namespace vehd

namespace Eigen::internal {

template <typename Rhs>
struct generic_product_impl<vehd::MatrixFree, Rhs, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<vehd::MatrixFree, Rhs, generic_product_impl<vehd::MatrixFree, Rhs>> {
  template <typename Dest>
  static void scaleAndAddTo(Dest& destination, const vehd::MatrixFree& matrix, const Rhs& x, const double& alpha) {
    destination.noalias() += alpha * matrix.apply(x);
  }
};

}  // namespace Eigen::internal

namespace vehd {

SolveReport gmres(const LinearMap& map, const LinearMap& preconditioner, const Vector& rhs, Vector& x,
                  const GmresOptions& options) {
  const double scale = preconditioner(rhs).norm();
  if (scale == 0.0) {
    x = Vector::Zero(rhs.size());
    return {true, 0, 0.0};
  }
  // Solving for the correction keeps the tolerance relative to the right-hand side however good the start is.
  Vector residual = rhs;
  if (!x.isZero(0.0)) residual -= map(x);
  const double start = preconditioner(residual).norm();
  if (!std::isfinite(start)) return {false, 0, start};
  if (start <= options.tolerance * scale) return {true, 0, start / scale};

  const MatrixFree matrix(map, rhs.size());
  Eigen::GMRES<MatrixFree, MapPreconditioner> solver;
  solver.preconditioner().set(preconditioner);
  solver.set_restart(std::min<Index>(options.max_iterations, rhs.size()));
  solver.setMaxIterations(options.max_iterations);
  solver.setTolerance(options.tolerance * scale / start);
  solver.compute(matrix);
  x += solver.solve(residual);
  const double relative = solver.error() * start / scale;
  const bool converged = solver.info() == Eigen::Success && relative <= options.tolerance && x.allFinite();
  return {converged, static_cast<int>(solver.iterations()), relative};
}

void require_converged(const SolveReport& report, const std::string& what) {
  if (!report.converged) {
    throw ConvergenceError(fmt::format("{}: GMRES did not converge, relative residual {:.2e} after {} iterations", what,
                                       report.residual, report.iterations));
  }
}

}  // namespace vehd
