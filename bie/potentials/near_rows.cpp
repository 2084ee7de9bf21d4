#include "bie/potentials/near_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/few_nodes.hpp"

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
  const auto field = [&](int column, Index i) { return few(nodes + column * n + i); };
  const auto dot = [](const Vector3& a, const Few& x, const Few& y, const Few& z) -> Few {
    return a[0] * x + a[1] * y + a[2] * z;
  };
  double angle = 0.0;
  for (Index next = 0; next < n; next += kTogether) {
    // The last ones begin earlier, so that they end with the circle, and find some of the nodes before them again.
    const Index i = std::min(next, n - kTogether);
    const auto put = [&](int row, const Few& values) { store(kernels + row * n + i, values); };
    const Few x = offset[0] - field(at.position, i), y = offset[1] - field(at.position + 1, i),
              z = offset[2] - field(at.position + 2, i);
    const Few ux = field(at.tangent_1, i), uy = field(at.tangent_1 + 1, i), uz = field(at.tangent_1 + 2, i);
    const Few vx = field(at.tangent_2, i), vy = field(at.tangent_2 + 1, i), vz = field(at.tangent_2 + 2, i);
    const Few inverse = inverse_root(x * x + y * y + z * z);
    const Few w = few(weight.data() + i);
    const Few area = x * (uy * vz - uz * vy) + y * (uz * vx - ux * vz) + z * (ux * vy - uy * vx);  // r·(u × v)
    const Few solid_angle = w * laplace_double_kernel(area, inverse);
    angle += sum(solid_angle, next - i);
    if (columns.single >= 0) put(columns.single, w * laplace_single_kernel(inverse));
    if (columns.single_normal >= 0) {
      put(columns.single_normal, w * laplace_adjoint_kernel(dot(normal, x, y, z), inverse));
    }
    if (columns.double_layer >= 0) put(columns.double_layer, solid_angle);
    if (columns.double_normal >= 0) {
      // −N·r/|r|³ × (f_1 v − f_2 u)
      const Few factor = w * inverse * inverse * inverse;
      put(columns.double_normal, -factor * dot(normal, y * vz - z * vy, z * vx - x * vz, x * vy - y * vx));
      put(columns.count, factor * dot(normal, y * uz - z * uy, z * ux - x * uz, x * uy - y * ux));
    }
    if (columns.stokes >= 0) {
      const std::array<Few, 6> g = stokeslet(x, y, z, inverse);
      for (int k = 0; k < 6; ++k) put(columns.stokes + k, w * g[k]);
    }
    if (columns.stokes_double >= 0) {
      const std::array<Few, 6> g = stokes_double_kernel(x, y, z, area, inverse);
      for (int k = 0; k < 6; ++k) put(columns.stokes_double + k, w * g[k]);
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
  RowMatrix kernels = RowMatrix::Zero(rule.n_phi, filled_up(n_all * n_theta));
  NearRows result;
  for (int k = 0; k < rule.n_phi; ++k) {
    result.enclosure += kLaplacePrefactor * circle_kernels(NodeColumns{}, nodes.row(k).data(), rule.weight, offset,
                                                           normal, columns, kernels.row(k).data());
  }
  // Adjoint of the Fourier sums, then of the Legendre sums of each m.
  const RowMatrix circles = rule.azimuths.adjoint(kernels);
  const std::vector<KernelKind> kinds = kinds_of(columns);
  const int order = static_cast<int>(rule.synthesis.size()) - 1;
  std::vector<RowMatrix> rotated;
  for (int m = 0; m <= order; ++m) {
    const RowMatrix& table = rule.adjoint[m];
    const Index width = table.cols();
    RowMatrix part = RowMatrix::Zero(2 * columns.count, width);
    Eigen::RowVectorXd tangent(width);
    // Rows of all columns from that of the circles' mode, by a kind of table.
    const auto sum_circles = [&](Index kind, Index mode, Index column, Index count, double* to) {
      small_product(count, n_theta, width, {circles.row(mode).data() + column * n_theta, n_theta, 1},
                    table.data() + kind * n_theta * width, width, to, width);
    };
    sum_circles(0, m, 0, columns.count, part.data());
    if (m > 0) sum_circles(0, order + m, 0, columns.count, part.row(columns.count).data());
    for (int c = 0; c < columns.count; ++c) {
      auto cosine = part.row(c);
      auto sine = part.row(columns.count + c);
      if (kinds[c].factor == NodeFactor::tangents) {
        sum_circles(1, m, c, 1, cosine.data());
        if (m > 0) {
          sum_circles(1, order + m, c, 1, sine.data());
          sum_circles(2, order + m, columns.count, 1, tangent.data());
          cosine -= tangent;
          sum_circles(2, m, columns.count, 1, tangent.data());
          sine += tangent;
        }
      }
      if (m == 0 && kinds[c].factor == NodeFactor::value) {
        // The tables hold differences from the pole.
        const double sum = circles.row(m).segment(c * n_theta, n_theta).sum();
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
