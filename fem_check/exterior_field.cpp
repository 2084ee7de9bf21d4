#include "fem_check/exterior_field.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "meshes/gauss_rule.hpp"
#include "meshes/harmonic_series.hpp"

namespace vehd::fem_check {
namespace {

Eigen::Index n_harmonics(int degree) { return Eigen::Index{degree + 1} * (degree + 1); }

/// All harmonics up to a degree, one per column.
meshes::HarmonicSeries all_harmonics(int degree) {
  return meshes::HarmonicSeries(Eigen::MatrixXd::Identity(n_harmonics(degree), n_harmonics(degree)));
}

/// A rule on the unit sphere that is exact for products of two fields with components up to a degree.
struct SphereRule {
  std::vector<Vector3> direction;
  std::vector<double> weight;

  explicit SphereRule(int degree) {
    const meshes::GaussRule gauss = meshes::gauss_rule(degree + 1);
    const int n_phi = 2 * degree + 1;
    for (std::size_t i = 0; i < gauss.node.size(); ++i) {
      for (int k = 0; k < n_phi; ++k) {
        const double theta = std::acos(gauss.node[i]), phi = 2.0 * std::numbers::pi * k / n_phi;
        direction.push_back(meshes::direction_of(theta, phi));
        weight.push_back(gauss.weight[i] * 2.0 * std::numbers::pi / n_phi);
      }
    }
  }
};

/// Fields ∇(r^l Y), r̂ × ∇Y and ∇(r^(−l−1) Y) on the unit sphere, orthogonal to one another.
std::array<Vector3, 3> modes_of(int l, double value, const Vector3& gradient, const Vector3& direction) {
  return {gradient + l * value * direction, direction.cross(gradient), gradient - (l + 1.0) * value * direction};
}

}  // namespace

Eigen::MatrixXd exterior_potential(int degree, double robin) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n_harmonics(degree), n_harmonics(degree));
  for (int l = 0; l <= degree; ++l) {
    for (Eigen::Index i = n_harmonics(l - 1); i < n_harmonics(l); ++i) result(i, i) = l + 1.0 - robin;
  }
  return result;
}

Eigen::MatrixXd exterior_flow(int degree, double robin) {
  // ∇(r^(−l−1) Y) has components of degree l + 1.
  const Eigen::Index n = n_harmonics(degree + 1), n_scalars = n_harmonics(degree);
  const meshes::HarmonicSeries harmonics = all_harmonics(degree + 1);
  const SphereRule rule(degree + 1);
  // Coefficients of the modes, [components x harmonics].
  std::array<Eigen::MatrixXd, 3> coefficients;
  coefficients.fill(Eigen::MatrixXd::Zero(3 * n, n_scalars));
  for (std::size_t q = 0; q < rule.weight.size(); ++q) {
    const Vector3& direction = rule.direction[q];
    Eigen::VectorXd value;
    Eigen::MatrixXd gradient;
    harmonics.value_and_gradient(direction, value, gradient);
    for (int l = 1; l <= degree; ++l) {
      for (Eigen::Index i = n_harmonics(l - 1); i < n_harmonics(l); ++i) {
        const std::array<Vector3, 3> modes = modes_of(l, value[i], gradient.row(i).transpose(), direction);
        for (std::size_t family = 0; family < modes.size(); ++family) {
          for (int d = 0; d < 3; ++d)
            coefficients[family].col(i).segment(d * n, n) += rule.weight[q] * modes[family][d] * value;
        }
      }
    }
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int l = 1; l <= degree; ++l) {
    const double ll = l;
    const std::array factors{3.0 * ll * ll / (ll + 1.0), ll + 1.0, ll + 2.0};
    const std::array squares{ll * (2.0 * ll + 1.0), ll * (ll + 1.0), (ll + 1.0) * (2.0 * ll + 1.0)};
    for (std::size_t family = 0; family < factors.size(); ++family) {
      const auto modes = coefficients[family].middleCols(n_harmonics(l - 1), 2 * l + 1);
      result += (factors[family] - robin) / squares[family] * modes * modes.transpose();
    }
  }
  return result;
}

HarmonicTerms::HarmonicTerms(const Space& space, const dealii::DoFHandler<3>& handler, const Constraints& constraints,
                             const OuterSphere& sphere, unsigned n_components, Eigen::MatrixXd matrix)
    : communicator_(space.communicator), matrix_(std::move(matrix)) {
  const auto degree = static_cast<int>(std::lround(std::sqrt(static_cast<double>(matrix_.rows() / n_components)))) - 1;
  const meshes::HarmonicSeries harmonics = all_harmonics(degree);
  const Eigen::MatrixXd all = sphere.moments([&](const Vectors& positions) {
    return harmonics.values((positions.colwise() - space.centre).colwise().normalized());
  });
  const dealii::IndexSet owned = handler.locally_owned_dofs();
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < sphere.dofs().size(); ++i) {
    const DofIndex dof = sphere.dofs()[i];
    if (!owned.is_element(dof) || constraints.is_constrained(dof)) continue;
    dofs_.push_back(dof);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  moments_ = all(rows, Eigen::all);
}

void HarmonicTerms::add(const std::vector<Distributed*>& to, const std::vector<const Distributed*>& from) const {
  const auto n_nodes = static_cast<Eigen::Index>(dofs_.size()), n_components = static_cast<Eigen::Index>(from.size());
  Eigen::MatrixXd values(n_nodes, n_components);
  for (Eigen::Index c = 0; c < n_components; ++c) {
    for (Eigen::Index i = 0; i < n_nodes; ++i) {
      values(i, c) = (*from[static_cast<std::size_t>(c)])(dofs_[static_cast<std::size_t>(i)]);
    }
  }
  Eigen::MatrixXd coefficients = moments_.transpose() * values;
  const dealii::ArrayView<double> all(coefficients.data(), static_cast<std::size_t>(coefficients.size()));
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all), communicator_, all);
  const Vector product = matrix_ * coefficients.reshaped();
  values.noalias() = moments_ * product.reshaped(coefficients.rows(), n_components);
  for (Eigen::Index c = 0; c < n_components; ++c) {
    for (Eigen::Index i = 0; i < n_nodes; ++i) {
      (*to[static_cast<std::size_t>(c)])(dofs_[static_cast<std::size_t>(i)]) += values(i, c);
    }
  }
}

}  // namespace vehd::fem_check
