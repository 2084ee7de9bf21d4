#include "fem_check/exterior_field.hpp"

#include <Eigen/Dense>
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

/// Quadrature rule on the unit sphere, exact for products of two fields with components up to a degree.
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

namespace {

/// Families of exterior flows up to a degree, on the unit sphere.
struct ExteriorFlows {
  static constexpr std::size_t n_families = 3;

  /// Coefficients of each flow in a column, [components x harmonics] x [harmonics]. The components of the third family
  /// have one degree more than its harmonic.
  std::array<Eigen::MatrixXd, n_families> coefficients;

  /// (p n − μ ∂u/∂r)/(μ u)
  static double factor(std::size_t family, double l) {
    return std::array{3.0 * l * l / (l + 1.0), l + 1.0, l + 2.0}[family];
  }
  /// ∫ |u|² dA
  static double square(std::size_t family, double l) {
    return std::array{l * (2.0 * l + 1.0), l * (l + 1.0), (l + 1.0) * (2.0 * l + 1.0)}[family];
  }
  [[nodiscard]] auto of_degree(std::size_t family, int l) const {
    return coefficients[family].middleCols(n_harmonics(l - 1), 2 * l + 1);
  }

  explicit ExteriorFlows(int degree) {
    const Eigen::Index n = n_harmonics(degree + 1), n_scalars = n_harmonics(degree);
    const meshes::HarmonicSeries harmonics = all_harmonics(degree + 1);
    const SphereRule rule(degree + 1);
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
  }
};

/// Block diagonal, the same block for each of three components.
Eigen::MatrixXd for_each_component(const Eigen::MatrixXd& block) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * block.rows(), 3 * block.cols());
  for (int d = 0; d < 3; ++d) result.block(d * block.rows(), d * block.cols(), block.rows(), block.cols()) = block;
  return result;
}

/// Orthonormal basis of the solutions x of matrix · x = 0.
Eigen::MatrixXd kernel_of(const Eigen::MatrixXd& matrix) {
  constexpr double rounding = 1e-9;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()[rank] > rounding) ++rank;
  return svd.matrixV().rightCols(matrix.cols() - rank);
}

/// A frame whose third axis is the normal.
Matrix3 frame_of(const Vector3& normal) {
  return Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), normal).toRotationMatrix();
}

/// Harmonics on the circle in which the sphere intersects a wall through its centre, [points x harmonics].
Eigen::MatrixXd on_rim(const meshes::HarmonicSeries& harmonics, int degree, const Vector3& normal) {
  const Matrix3 frame = frame_of(normal);
  const int n_points = 2 * degree + 1;
  Eigen::Matrix3Xd points(3, n_points);
  for (int k = 0; k < n_points; ++k) {
    points.col(k) = frame * meshes::direction_of(0.5 * std::numbers::pi, 2.0 * std::numbers::pi * k / n_points);
  }
  return harmonics.values(points).transpose();
}

/// ∫ of the products of harmonics up to a degree over the half sphere above the wall.
Eigen::MatrixXd half_sphere_products(const meshes::HarmonicSeries& harmonics, int degree, const Vector3& normal) {
  const Matrix3 frame = frame_of(normal);
  const meshes::GaussRule gauss = meshes::gauss_rule(degree + 1);
  const int n_phi = 2 * degree + 1;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n_harmonics(degree), n_harmonics(degree));
  for (std::size_t i = 0; i < gauss.node.size(); ++i) {
    const double theta = std::acos(0.5 + 0.5 * gauss.node[i]);
    for (int k = 0; k < n_phi; ++k) {
      const Eigen::VectorXd value =
          harmonics.value(frame * meshes::direction_of(theta, 2.0 * std::numbers::pi * k / n_phi));
      result += 0.5 * gauss.weight[i] * 2.0 * std::numbers::pi / n_phi * value * value.transpose();
    }
  }
  return result;
}

}  // namespace

Eigen::MatrixXd exterior_flow(int degree, double robin) {
  const ExteriorFlows flows(degree);
  const Eigen::Index size = flows.coefficients[0].rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (int l = 1; l <= degree; ++l) {
    for (std::size_t family = 0; family < ExteriorFlows::n_families; ++family) {
      const auto modes = flows.of_degree(family, l);
      result +=
          (ExteriorFlows::factor(family, l) - robin) / ExteriorFlows::square(family, l) * modes * modes.transpose();
    }
  }
  return result;
}

Eigen::MatrixXd continued(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& mirror, const Vector3& normal) {
  const Eigen::Index n_components = mirror.rows(), n = matrix.rows() / n_components;
  const auto degree = static_cast<int>(std::lround(std::sqrt(static_cast<double>(n)))) - 1;
  const meshes::HarmonicSeries harmonics = all_harmonics(degree);
  const SphereRule rule(degree);
  Eigen::MatrixXd images = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t q = 0; q < rule.weight.size(); ++q) {
    const Vector3& direction = rule.direction[q];
    const Vector3 image = direction - 2.0 * normal.dot(direction) * normal;
    images += rule.weight[q] * harmonics.value(direction) * harmonics.value(image).transpose();
  }
  // Moments over the whole sphere are sums over the half and its image; the energy is that of the half.
  Eigen::MatrixXd both = Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols());
  for (Eigen::Index i = 0; i < n_components; ++i) {
    for (Eigen::Index j = 0; j < n_components; ++j) both.block(i * n, j * n, n, n) += mirror(i, j) * images;
  }
  return 0.5 * both.transpose() * matrix * both;
}

Eigen::MatrixXd exterior_flow_at_rest_on_wall(int degree, double robin, const Vector3& normal) {
  const ExteriorFlows flows(degree);
  const meshes::HarmonicSeries harmonics = all_harmonics(degree + 1);
  const Eigen::MatrixXd at_rim = for_each_component(on_rim(harmonics, degree + 1, normal));
  const Eigen::Index size = flows.coefficients[0].rows();
  const auto append = [size](Eigen::MatrixXd& to, const Eigen::MatrixXd& columns) {
    to.conservativeResize(size, to.cols() + columns.cols());
    to.rightCols(columns.cols()) = columns;
  };
  Eigen::MatrixXd velocity(size, 0), traction(size, 0);
  for (int decay = 1; decay <= degree; ++decay) {
    Eigen::MatrixXd velocities(size, 0), tractions(size, 0);
    for (std::size_t family = 0; family < ExteriorFlows::n_families; ++family) {
      // Powers of r of the families: r^(−l) with a pressure, r^(−l−1), r^(−l−2).
      const int l = decay - static_cast<int>(family);
      if (l < 1) continue;
      Eigen::MatrixXd modes = flows.of_degree(family, l), own = ExteriorFlows::factor(family, l) * modes;
      if (family == 0) {
        // The first family continues as r^(−l) and a part of r^(−l−2) of the third one, which is subtracted here.
        const double share = (l + 1.0) / (2.0 * l + 1.0), of_third = 0.5 * (2.0 - l) - share;
        modes = share * modes + of_third * flows.of_degree(2, l);
        own = share * own + of_third * ExteriorFlows::factor(2, l) * flows.of_degree(2, l);
      }
      const double scale = 1.0 / modes.col(0).norm();
      append(velocities, scale * modes);
      append(tractions, scale * own);
    }
    const Eigen::MatrixXd at_rest = kernel_of(at_rim * velocities);
    append(velocity, velocities * at_rest);
    append(traction, tractions * at_rest);
  }
  // Exterior flows with the energies A = ∫ Uᵀ T have c = A⁻¹ ∫ Tᵀ u.
  const Eigen::MatrixXd products = for_each_component(half_sphere_products(harmonics, degree + 1, normal));
  const Eigen::MatrixXd energies = velocity.transpose() * products * traction;
  const Eigen::MatrixXd shares = (0.5 * (energies + energies.transpose())).ldlt().solve(traction.transpose());
  const Eigen::MatrixXd part = velocity * shares;
  const Eigen::MatrixXd result =
      traction * shares + robin * (part.transpose() * products * part - part - part.transpose());
  return 0.5 * (result + result.transpose());
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
