#include "bie/potentials/assembly_arithmetic.hpp"

#include <algorithm>

#include "bie/potentials/kernel_columns.hpp"
#include "bie/potentials/target_images.hpp"
#include "bie/potentials/target_rows.hpp"

namespace vehd {

namespace {

double product(double rows, double inner, double columns) { return 2.0 * rows * inner * columns; }

/// Wigner rotation of so many columns of coefficients, or its adjoint.
double rotation(int order, int azimuthal_order, const FourierColumns& columns) {
  const auto cosines = static_cast<double>(columns.cosine.size());
  const auto sines = static_cast<double>(columns.sine.size());
  double operations = 0.0;
  for (int n = 0; n <= order; ++n) {
    const int m = std::min(n, azimuthal_order);
    operations += product(n + 1, m + 1, cosines) + product(n, m, sines);
  }
  return operations;
}

/// Legendre sums at the nodes of the rotated grid, or their adjoint; a column has cosines or sines.
double legendre_sums(const RotatedQuadrature& quadrature, double columns) {
  double operations = 0.0;
  for (int m = 0; m <= quadrature.order; ++m) {
    operations += product(quadrature.n_theta, quadrature.order + 1 - m, columns);
  }
  return operations;
}

/// Sums over the azimuth, even and odd orders apart on a quarter of it, or their adjoint.
double fourier_sums(const RotatedQuadrature& quadrature, double columns) {
  const double quarter = quadrature.n_phi / 4;
  return product(quarter, quadrature.order + 1, quadrature.n_theta * columns);
}

/// Kernel values at one node.
double kernel_values(const KernelColumns& kernels) {
  constexpr double kDistance = 10.0, kAreaVector = 14.0;
  constexpr double kSingle = 2.0, kDouble = 5.0, kAdjoint = 10.0, kStokeslet = 26.0, kStresslet = 24.0;
  double operations = kDistance;
  if (kernels.single >= 0) operations += kSingle;
  if (kernels.double_layer >= 0) operations += kAreaVector + kDouble;
  if (kernels.adjoint >= 0) operations += kAdjoint;
  if (kernels.stokes >= 0) operations += kStokeslet;
  if (kernels.stokes_double >= 0) operations += kAreaVector + kStresslet;
  return operations;
}

}  // namespace

double operations_per_assembly(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                               const LayerSelection& selection, const std::vector<Reflection>& reflections, int fold) {
  const KernelColumns kernels(selection);
  if (kernels.count == 0) return 0.0;
  const SphereGrid& grid = transform.grid();
  const int order = quadrature.order;
  const int azimuthal_order = transform.azimuthal_order();
  const ActiveCoefficients active(order, azimuthal_order);
  const TargetImages images({reflections, fold}, kernels, active, grid.n_phi);
  const double n_latitudes = images.flip() ? (grid.n_theta + 1) / 2 : grid.n_theta;
  const FourierColumns shape = shape_columns(images.in_mirror());
  const FourierColumns row = row_columns(kernels, images.in_mirror());
  const double shape_fields = static_cast<double>(shape.count()) * (kernels.need_source_normal() ? 3.0 : 1.0);
  const double row_fields = static_cast<double>(row.count());
  const double n_nodes = static_cast<double>(quadrature.n_nodes()) / (images.in_mirror() ? 2.0 : 1.0);

  const double of_a_target = rotation(order, azimuthal_order, shape) + legendre_sums(quadrature, shape_fields) +
                             fourier_sums(quadrature, shape_fields) + n_nodes * kernel_values(kernels) +
                             fourier_sums(quadrature, row_fields) + legendre_sums(quadrature, row_fields) +
                             rotation(order, azimuthal_order, row);
  const double n_rows = static_cast<double>(kernels.count) * static_cast<double>(active.count());
  const double to_modes = n_latitudes * product(2 * azimuthal_order + 1, grid.n_phi, n_rows);
  double to_degrees = 0.0;
  for (int m = -azimuthal_order; m <= azimuthal_order; ++m) {
    to_degrees += product(n_rows, grid.n_theta, order + 1 - std::abs(m));
  }
  return n_latitudes * static_cast<double>(images.originals().size()) * of_a_target + to_modes + to_degrees;
}

}  // namespace vehd
