#include "bie/potentials/near_rows.hpp"

#include <cmath>
#include <numbers>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"

namespace vehd {

PairColumns::PairColumns(const PairSelection& selection) {
  if (selection.laplace_single) single = count++;
  if (selection.laplace_single_normal) single_normal = count++;
  if (selection.laplace_double) double_layer = count++;
  if (selection.laplace_double_normal) double_normal = count++;
  constexpr int kStokesBlocks = 6;
  if (selection.stokes_single) {
    stokes = count;
    count += kStokesBlocks;
  }
  if (selection.stokes_double) {
    stokes_double = count;
    count += kStokesBlocks;
  }
}

namespace {

/// What a kernel multiplies at a node.
enum class NodeFactor { value, difference, tangents };

struct KernelKind {
  NodeFactor factor;
  double prefactor;
};

/// Of every row.
std::vector<KernelKind> kinds_of(const PairColumns& columns) {
  std::vector<KernelKind> kinds(columns.count);
  if (columns.single >= 0) kinds[columns.single] = {NodeFactor::value, kLaplacePrefactor};
  if (columns.single_normal >= 0) kinds[columns.single_normal] = {NodeFactor::value, kLaplacePrefactor};
  if (columns.double_layer >= 0) kinds[columns.double_layer] = {NodeFactor::difference, kLaplacePrefactor};
  if (columns.double_normal >= 0) kinds[columns.double_normal] = {NodeFactor::tangents, kLaplacePrefactor};
  for (int i = 0; i < 6; ++i) {
    if (columns.stokes >= 0) kinds[columns.stokes + i] = {NodeFactor::value, stokes_single_layer_prefactor(1.0)};
    if (columns.stokes_double >= 0)
      kinds[columns.stokes_double + i] = {NodeFactor::difference, kStokesDoubleLayerPrefactor};
  }
  return kinds;
}

/// Kernels times weights on one circle of nodes, [columns + 1 x n_theta]: the last row is the second tangent's of the
/// normal derivative of D. @return ∫ r·J n/|r|³ of the circle
double circle_kernels(const NodeColumns& at, const double* nodes, const Vector& weight, const Vector3& offset,
                      const Vector3& normal, const PairColumns& columns, double* kernels) {
  const Index n = weight.size();
  const auto field = [&](int column) { return nodes + column * n; };
  const auto out = [&](int row) { return kernels + row * n; };
  const double *px = field(at.position), *py = field(at.position + 1), *pz = field(at.position + 2);
  const double *ux = field(at.tangent_1), *uy = field(at.tangent_1 + 1), *uz = field(at.tangent_1 + 2);
  const double *vx = field(at.tangent_2), *vy = field(at.tangent_2 + 1), *vz = field(at.tangent_2 + 2);
  double angle = 0.0;
  for (Index i = 0; i < n; ++i) {
    const Vector3 r(offset[0] - px[i], offset[1] - py[i], offset[2] - pz[i]);
    const Vector3 u(ux[i], uy[i], uz[i]), v(vx[i], vy[i], vz[i]);
    const double inverse = 1.0 / r.norm();
    const double inverse3 = inverse * inverse * inverse;
    const double w = weight[i];
    const double r_dot_area = r.dot(u.cross(v));
    const double solid_angle = w * laplace_double_kernel(r_dot_area, inverse);
    angle += solid_angle;
    if (columns.single >= 0) out(columns.single)[i] = w * laplace_single_kernel(inverse);
    if (columns.single_normal >= 0) {
      out(columns.single_normal)[i] = w * laplace_adjoint_kernel(r.dot(normal), inverse);
    }
    if (columns.double_layer >= 0) out(columns.double_layer)[i] = solid_angle;
    if (columns.double_normal >= 0) {
      // −N·r/|r|³ × (f_1 v − f_2 u)
      out(columns.double_normal)[i] = -w * inverse3 * normal.dot(r.cross(v));
      out(columns.count)[i] = w * inverse3 * normal.dot(r.cross(u));
    }
    if (columns.stokes >= 0) {
      const auto g = stokeslet(r[0], r[1], r[2], inverse);
      for (int k = 0; k < 6; ++k) out(columns.stokes + k)[i] = w * g[k];
    }
    if (columns.stokes_double >= 0) {
      const auto g = stokes_double_kernel(r[0], r[1], r[2], r_dot_area, inverse);
      for (int k = 0; k < 6; ++k) out(columns.stokes_double + k)[i] = w * g[k];
    }
  }
  return angle;
}

}  // namespace

NearRows near_rows(const TargetFrame& frame, const GradedRule& rule, const Vector3& offset, const Vector3& normal,
                   const PairColumns& columns) {
  const Index n_theta = rule.theta.size();
  const Index n_all = columns.count + 1;
  const RowMatrix nodes = frame.nodes(rule);
  RowMatrix kernels = RowMatrix::Zero(rule.n_phi, n_all * n_theta);
  NearRows result;
  for (int k = 0; k < rule.n_phi; ++k) {
    result.enclosure += kLaplacePrefactor * circle_kernels(NodeColumns{}, nodes.row(k).data(), rule.weight, offset,
                                                           normal, columns, kernels.row(k).data());
  }
  // Adjoint of the Fourier sums, then of the Legendre sums of each m.
  const RowMatrix circles = rule.fourier.transpose() * kernels;
  const std::vector<KernelKind> kinds = kinds_of(columns);
  const int order = static_cast<int>(rule.synthesis.size()) - 1;
  std::vector<Matrix> rotated;
  for (int m = 0; m <= order; ++m) {
    const auto table = [&](Index kind) { return rule.synthesis[m].middleRows(kind * n_theta, n_theta).transpose(); };
    // of all columns, one beside the other, on all circles
    const Eigen::Map<const Matrix> cosines(circles.row(m).data(), n_theta, n_all);
    const Eigen::Map<const Matrix> sines(circles.row(order + m).data(), n_theta, n_all);
    Matrix part(order + 1 - m, 2 * columns.count);
    part.leftCols(columns.count).noalias() = table(0) * cosines.leftCols(columns.count);
    if (m > 0) {
      part.rightCols(columns.count).noalias() = table(0) * sines.leftCols(columns.count);
    } else {
      part.rightCols(columns.count).setZero();
    }
    for (int c = 0; c < columns.count; ++c) {
      auto cosine = part.col(c);
      auto sine = part.col(columns.count + c);
      if (kinds[c].factor == NodeFactor::tangents) {
        cosine.noalias() = table(1) * cosines.col(c);
        if (m > 0) {
          cosine.noalias() -= table(2) * sines.col(columns.count);
          sine.noalias() = table(1) * sines.col(c);
          sine.noalias() += table(2) * cosines.col(columns.count);
        }
      }
      if (m == 0 && kinds[c].factor == NodeFactor::value) {
        // The tables hold differences from the pole.
        const double sum = cosines.col(c).sum();
        for (int n = 0; n <= order; ++n) cosine[n] += std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi)) * sum;
      }
      cosine *= kinds[c].prefactor;
      sine *= kinds[c].prefactor;
    }
    rotated.push_back(std::move(part));
  }
  result.rows = frame.rotated_back(rotated);
  return result;
}

}  // namespace vehd
