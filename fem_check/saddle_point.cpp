#include "fem_check/minimal_residuals.hpp"

namespace vehd::fem_check {

namespace {

/// Gradients of all shape functions in one direction, scaled by the root of the weight: [n_dofs x n_points].
Eigen::MatrixXd weighted_derivative(const dealii::FEValues<3>& fe, unsigned direction) {
  Eigen::MatrixXd result(fe.dofs_per_cell, fe.n_quadrature_points);
  for (unsigned q = 0; q < fe.n_quadrature_points; ++q) {
    const double root = std::sqrt(fe.JxW(q));
    for (unsigned i = 0; i < fe.dofs_per_cell; ++i) result(i, q) = root * fe.shape_grad(i, q)[direction];
  }
  return result;
}

Eigen::MatrixXd weighted_value(const dealii::FEValues<3>& fe) {
  Eigen::MatrixXd result(fe.dofs_per_cell, fe.n_quadrature_points);
  for (unsigned q = 0; q < fe.n_quadrature_points; ++q) {
    const double root = std::sqrt(fe.JxW(q));
    for (unsigned i = 0; i < fe.dofs_per_cell; ++i) result(i, q) = root * fe.shape_value(i, q);
  }
  return result;
}

void add(DistributedMatrix& matrix, const std::vector<DofIndex>& rows, const std::vector<DofIndex>& columns,
         const Eigen::MatrixXd& local) {
  dealii::FullMatrix<double> full(static_cast<unsigned>(local.rows()), static_cast<unsigned>(local.cols()));
  for (Eigen::Index i = 0; i < local.rows(); ++i) {
    for (Eigen::Index j = 0; j < local.cols(); ++j) full(i, j) = local(i, j);
  }
  matrix.add(rows, columns, full);
}

/// Smallest and largest eigenvalue of a mass matrix against its diagonal. The extremes over all cells bound those of
/// the whole matrix.
std::array<double, 2> scaled_bounds(const Eigen::MatrixXd& mass) {
  const Vector scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * mass * scale.asDiagonal(),
                                                             Eigen::EigenvaluesOnly);
  return {eigen.eigenvalues().minCoeff(), eigen.eigenvalues().maxCoeff()};
}

std::vector<DofIndex> representatives(const Constraints& constraints, DofIndex n) {
  std::vector<DofIndex> result(n);
  for (DofIndex dof = 0; dof < n; ++dof) {
    result[dof] = constraints.is_constrained(dof) ? constraints.get_constraint_entries(dof)->front().first : dof;
  }
  return result;
}

/// diag(A, A, A, M_p/μ)⁻¹, approximately: one multigrid cycle per component and a Chebyshev polynomial.
struct BlockPreconditioner {
  const dealii::TrilinosWrappers::PreconditionAMG& velocity;
  const dealii::TrilinosWrappers::PreconditionChebyshev& pressure;

  void vmult(Blocks& result, const Blocks& x) const {
    for (unsigned d = 0; d < 3; ++d) velocity.vmult(result.block(d), x.block(d));
    pressure.vmult(result.block(3), x.block(3));
  }
};

/// Position of the pair (a, b), a ≤ b, among the six stored ones.
unsigned pair_index(unsigned a, unsigned b) { return a == 0 ? b : a + b + 1; }

}  // namespace

SaddlePoint::SaddlePoint(const Space& space, const dealii::DoFHandler<3>& pressure_dofs, const Constraints& constraints,
                         const Viscosities& viscosity)
    : space_(space),
      pressure_dofs_(pressure_dofs),
      tied_(representatives(constraints, space.dofs.n_dofs())),
      diffusion_(space, constraints,
                 {viscosity.inside, viscosity.outside, 0.0, 4.0 * viscosity.outside / space.mesh->outer_radius()}) {
  Stopwatch watch;
  assemble_divergence();
  assemble_pressure_mass(viscosity);
  if (viscosity.inside != viscosity.outside) assemble_contrast(viscosity);
  seconds_assembly_ = diffusion_.seconds_assembly() + watch.lap();
}

Blocks SaddlePoint::zero() const {
  const dealii::IndexSet velocity = space_.dofs.locally_owned_dofs();
  return Blocks({velocity, velocity, velocity, pressure_dofs_.locally_owned_dofs()}, space_.communicator);
}

void SaddlePoint::assemble_divergence() {
  const unsigned degree = space_.element.degree;
  dealii::DynamicSparsityPattern pattern(pressure_dofs_.n_dofs(), space_.dofs.n_dofs());
  std::vector<DofIndex> columns(space_.element.n_dofs_per_cell());
  std::vector<DofIndex> rows(pressure_dofs_.get_fe().n_dofs_per_cell());
  const auto get_indices = [&](const Space::Cell& cell) {
    cell->get_dof_indices(columns);
    for (DofIndex& dof : columns) dof = tied_[dof];
    space_.cell(pressure_dofs_, static_cast<unsigned>(cell->index()))->get_dof_indices(rows);
  };
  for (const auto& cell : space_.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    get_indices(cell);
    std::vector<DofIndex> sorted = columns;
    std::sort(sorted.begin(), sorted.end());
    for (const DofIndex row : rows) pattern.add_entries(row, sorted.begin(), sorted.end(), true);
  }
  const dealii::IndexSet owned = pressure_dofs_.locally_owned_dofs();
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned, space_.communicator,
                                                     dealii::complete_index_set(pressure_dofs_.n_dofs()));
  for (auto& matrix : divergence_) {
    matrix.reinit(owned, space_.dofs.locally_owned_dofs(), pattern, space_.communicator);
  }
  const dealii::QGauss<3> quadrature(degree + 2);
  dealii::FEValues<3> velocity(space_.mapping, space_.element, quadrature,
                               dealii::update_gradients | dealii::update_JxW_values);
  dealii::FEValues<3> pressure(space_.mapping, pressure_dofs_.get_fe(), quadrature,
                               dealii::update_values | dealii::update_JxW_values);
  for (const auto& cell : space_.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    get_indices(cell);
    velocity.reinit(cell);
    pressure.reinit(space_.cell(pressure_dofs_, static_cast<unsigned>(cell->index())));
    const Eigen::MatrixXd values = weighted_value(pressure);
    for (unsigned d = 0; d < 3; ++d) {
      add(divergence_[d], rows, columns, -values * weighted_derivative(velocity, d).transpose());
    }
  }
  for (auto& matrix : divergence_) matrix.compress(dealii::VectorOperation::add);
}

void SaddlePoint::assemble_pressure_mass(const Viscosities& viscosity) {
  const unsigned degree = pressure_dofs_.get_fe().degree;
  dealii::DynamicSparsityPattern pattern(pressure_dofs_.n_dofs());
  dealii::DoFTools::make_sparsity_pattern(pressure_dofs_, pattern, Constraints(), false,
                                          space_.triangulation.locally_owned_subdomain());
  const dealii::IndexSet owned = pressure_dofs_.locally_owned_dofs();
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned, space_.communicator,
                                                     dealii::complete_index_set(pressure_dofs_.n_dofs()));
  pressure_mass_.reinit(owned, owned, pattern, space_.communicator);
  dealii::FEValues<3> fe(space_.mapping, pressure_dofs_.get_fe(), dealii::QGauss<3>(degree + 2),
                         dealii::update_values | dealii::update_JxW_values);
  std::vector<DofIndex> rows(fe.dofs_per_cell);
  double low = 1.0;
  double high = 1.0;
  for (const auto& cell : pressure_dofs_.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe.reinit(cell);
    cell->get_dof_indices(rows);
    const bool inside = space_.inside(static_cast<unsigned>(cell->index()));
    const Eigen::MatrixXd values = weighted_value(fe);
    const Eigen::MatrixXd mass = 1.0 / (inside ? viscosity.inside : viscosity.outside) * values * values.transpose();
    add(pressure_mass_, rows, rows, mass);
    const auto [cell_low, cell_high] = scaled_bounds(mass);
    low = std::min(low, cell_low);
    high = std::max(high, cell_high);
  }
  pressure_mass_.compress(dealii::VectorOperation::add);

  low = dealii::Utilities::MPI::min(low, space_.communicator);
  high = dealii::Utilities::MPI::max(high, space_.communicator);
  dealii::TrilinosWrappers::PreconditionChebyshev::AdditionalData data;
  data.degree = 8;
  data.max_eigenvalue = high;
  data.min_eigenvalue = low;
  data.eigenvalue_ratio = high / low;
  pressure_inverse_.initialize(pressure_mass_, data);
}

void SaddlePoint::assemble_contrast(const Viscosities& viscosity) {
  const bool on_inside = viscosity.inside > viscosity.outside;
  const double contrast = std::abs(viscosity.inside - viscosity.outside);
  const unsigned degree = space_.element.degree;
  std::vector<DofIndex> dofs(space_.element.n_dofs_per_cell());
  const auto get_indices = [&](const Space::Cell& cell) {
    cell->get_dof_indices(dofs);
    for (DofIndex& dof : dofs) dof = tied_[dof];
  };
  const auto wanted = [&](const Space::Cell& cell) {
    return cell->is_locally_owned() && space_.inside(static_cast<unsigned>(cell->index())) == on_inside;
  };
  dealii::DynamicSparsityPattern pattern(space_.dofs.n_dofs());
  for (const auto& cell : space_.dofs.active_cell_iterators()) {
    if (!wanted(cell)) continue;
    get_indices(cell);
    std::vector<DofIndex> sorted = dofs;
    std::sort(sorted.begin(), sorted.end());
    for (const DofIndex row : dofs) pattern.add_entries(row, sorted.begin(), sorted.end(), true);
  }
  const dealii::IndexSet owned = space_.dofs.locally_owned_dofs();
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned, space_.communicator,
                                                     dealii::complete_index_set(space_.dofs.n_dofs()));
  contrast_.resize(6);
  for (auto& matrix : contrast_) matrix.reinit(owned, owned, pattern, space_.communicator);

  // Test component a, trial component b: ∫ ∂_b w ∂_a u.
  dealii::FEValues<3> fe(space_.mapping, space_.element, dealii::QGauss<3>(degree + 2),
                         dealii::update_gradients | dealii::update_JxW_values);
  for (const auto& cell : space_.dofs.active_cell_iterators()) {
    if (!wanted(cell)) continue;
    fe.reinit(cell);
    get_indices(cell);
    std::array<Eigen::MatrixXd, 3> derivative;
    for (unsigned d = 0; d < 3; ++d) derivative[d] = weighted_derivative(fe, d);
    for (unsigned a = 0; a < 3; ++a) {
      for (unsigned b = a; b < 3; ++b) {
        add(contrast_[pair_index(a, b)], dofs, dofs, contrast * derivative[b] * derivative[a].transpose());
      }
    }
  }
  // ∇u:∇wᵀ outside brings (∇u)ᵀn to the outer sphere, which is not part of the condition there; with div u = 0 it is
  // a surface operator, taken off here.
  if (!on_inside) {
    dealii::FEFaceValues<3> face(
        space_.mapping, space_.element, dealii::QGauss<2>(degree + 2),
        dealii::update_values | dealii::update_gradients | dealii::update_normal_vectors | dealii::update_JxW_values);
    const unsigned n = face.dofs_per_cell;
    for (const OuterFace& outer : space_.outer) {
      const auto cell = space_.cell(outer.cell);
      if (!cell->is_locally_owned()) continue;
      face.reinit(cell, outer.face);
      get_indices(cell);
      for (unsigned a = 0; a < 3; ++a) {
        for (unsigned b = a + 1; b < 3; ++b) {
          Eigen::MatrixXd local = Eigen::MatrixXd::Zero(n, n);
          for (unsigned q = 0; q < face.n_quadrature_points; ++q) {
            const auto& normal = face.normal_vector(q);
            Vector test(n);
            Vector trial(n);
            for (unsigned i = 0; i < n; ++i) {
              test[i] = face.shape_value(i, q);
              trial[i] = normal[b] * face.shape_grad(i, q)[a] - normal[a] * face.shape_grad(i, q)[b];
            }
            local.noalias() -= contrast * face.JxW(q) * test * trial.transpose();
          }
          add(contrast_[pair_index(a, b)], dofs, dofs, local);
        }
      }
    }
  }
  for (auto& matrix : contrast_) matrix.compress(dealii::VectorOperation::add);
}

void SaddlePoint::vmult(Blocks& result, const Blocks& x) const {
  for (unsigned d = 0; d < 3; ++d) {
    diffusion_.matrix().vmult(result.block(d), x.block(d));
    divergence_[d].Tvmult_add(result.block(d), x.block(3));
  }
  divergence_[0].vmult(result.block(3), x.block(0));
  divergence_[1].vmult_add(result.block(3), x.block(1));
  divergence_[2].vmult_add(result.block(3), x.block(2));
  if (contrast_.empty()) return;
  for (unsigned a = 0; a < 3; ++a) {
    for (unsigned b = a; b < 3; ++b) {
      contrast_[pair_index(a, b)].vmult_add(result.block(a), x.block(b));
      if (a != b) contrast_[pair_index(a, b)].Tvmult_add(result.block(b), x.block(a));
    }
  }
}

void SaddlePoint::precondition(Blocks& result, const Blocks& x) const {
  BlockPreconditioner{diffusion_.preconditioner(), pressure_inverse_}.vmult(result, x);
}

Blocks SaddlePoint::solve(const Blocks& b, double tolerance, int& iterations) const {
  return minimal_residuals(*this, BlockPreconditioner{diffusion_.preconditioner(), pressure_inverse_}, b, tolerance,
                           iterations);
}

}  // namespace vehd::fem_check
