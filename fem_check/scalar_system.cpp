#include "fem_check/scalar_system.hpp"

#include <string>

namespace vehd::fem_check {

namespace {

/// Rows of the sparsity pattern that this rank has, with entries that other ranks own handed to them.
void initialise(DistributedMatrix& matrix, dealii::DynamicSparsityPattern& pattern, const Space& space) {
  const dealii::IndexSet owned = space.dofs.locally_owned_dofs();
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned, space.communicator,
                                                     dealii::complete_index_set(space.dofs.n_dofs()));
  matrix.reinit(owned, owned, pattern, space.communicator);
}

/// Inner then outer degrees of freedom of one face.
std::vector<DofIndex> both_sheets(const SheetPairs& pairs, std::size_t face) {
  std::vector<DofIndex> result;
  for (const std::size_t side : {0, 1}) {
    for (const int pair : pairs.of_face[face]) result.push_back(pairs.pairs[pair][side]);
  }
  return result;
}

/// Faces of γ whose inner cell this rank owns.
std::vector<std::size_t> owned_faces(const Space& space) {
  std::vector<std::size_t> result;
  for (std::size_t f = 0; f < space.membrane.size(); ++f) {
    if (space.cell(space.membrane[f].inner_cell)->is_locally_owned()) result.push_back(f);
  }
  return result;
}

/// [[m, −m], [−m, m]] for the product [[u]][[w]].
dealii::FullMatrix<double> jump_matrix(const Eigen::MatrixXd& m) {
  const auto n = static_cast<unsigned>(m.rows());
  dealii::FullMatrix<double> result(2 * n, 2 * n);
  for (unsigned a = 0; a < n; ++a) {
    for (unsigned b = 0; b < n; ++b) {
      result(a, b) = result(n + a, n + b) = m(a, b);
      result(a, n + b) = result(n + a, b) = -m(a, b);
    }
  }
  return result;
}

/// Gradients of all shape functions at all points, each scaled by the root of its weight: [n_dofs x 3 n_points].
Eigen::MatrixXd weighted_gradients(const dealii::FEValues<3>& fe) {
  Eigen::MatrixXd result(fe.dofs_per_cell, 3 * fe.n_quadrature_points);
  for (unsigned q = 0; q < fe.n_quadrature_points; ++q) {
    const double root = std::sqrt(fe.JxW(q));
    for (unsigned i = 0; i < fe.dofs_per_cell; ++i) {
      const auto& gradient = fe.shape_grad(i, q);
      for (unsigned d = 0; d < 3; ++d) result(i, 3 * q + d) = root * gradient[d];
    }
  }
  return result;
}

/// Stiffness matrix of the trilinear element with the given vertices.
Eigen::Matrix<double, 8, 8> trilinear_stiffness(const Eigen::Matrix<double, 3, 8>& vertices) {
  static const auto kDerivatives = [] {
    std::array<Eigen::Matrix<double, 3, 8>, 8> result;
    const double g = 0.5 / std::sqrt(3.0);
    for (int q = 0; q < 8; ++q) {
      for (int v = 0; v < 8; ++v) {
        std::array<double, 3> value{};
        std::array<double, 3> slope{};
        for (int d = 0; d < 3; ++d) {
          const double x = 0.5 + ((q >> d & 1) != 0 ? g : -g);
          const bool high = (v >> d & 1) != 0;
          value[d] = high ? x : 1.0 - x;
          slope[d] = high ? 1.0 : -1.0;
        }
        result[q].col(v) << slope[0] * value[1] * value[2], value[0] * slope[1] * value[2],
            value[0] * value[1] * slope[2];
      }
    }
    return result;
  }();
  Eigen::Matrix<double, 8, 8> stiffness = Eigen::Matrix<double, 8, 8>::Zero();
  for (const auto& derivative : kDerivatives) {
    const Matrix3 jacobian = vertices * derivative.transpose();
    const Eigen::Matrix<double, 3, 8> gradient = jacobian.transpose().inverse() * derivative;
    stiffness.noalias() += 0.125 * std::abs(jacobian.determinant()) * gradient.transpose() * gradient;
  }
  return stiffness;
}

/// Sub-cells between neighbouring nodes, as local node numbers.
std::vector<std::array<unsigned, 8>> sub_cells(const dealii::FE_Q<3>& element) {
  const unsigned k = element.degree;
  const std::vector<unsigned> hierarchic = element.get_poly_space_numbering_inverse();
  std::vector<std::array<unsigned, 8>> result;
  for (unsigned z = 0; z < k; ++z) {
    for (unsigned y = 0; y < k; ++y) {
      for (unsigned x = 0; x < k; ++x) {
        auto& cell = result.emplace_back();
        for (unsigned v = 0; v < 8; ++v) {
          cell[v] = hierarchic[(x + (v & 1)) + (k + 1) * ((y + (v >> 1 & 1)) + (k + 1) * (z + (v >> 2 & 1)))];
        }
      }
    }
  }
  return result;
}

}  // namespace

ScalarSystem::ScalarSystem(const Space& space, const Constraints& constraints, const ScalarForm& form)
    : space_(space), constraints_(constraints) {
  Stopwatch watch;
  assemble(form);
  seconds_assembly_ = watch.lap();
  assemble_preconditioner(form);
  seconds_preconditioner_ = watch.lap();
}

void ScalarSystem::assemble(const ScalarForm& form) {
  const MembraneTrace& trace = *space_.trace;
  const std::vector<std::size_t> faces = owned_faces(space_);
  dealii::DynamicSparsityPattern pattern(space_.dofs.n_dofs());
  dealii::DoFTools::make_sparsity_pattern(space_.dofs, pattern, constraints_, false,
                                          space_.triangulation.locally_owned_subdomain());
  if (form.membrane != 0.0) {
    for (const std::size_t f : faces) {
      constraints_.add_entries_local_to_global(both_sheets(trace.pairs(), f), pattern, false);
    }
  }
  initialise(matrix_, pattern, space_);

  const unsigned degree = space_.element.degree;
  dealii::FEValues<3> fe(space_.mapping, space_.element, dealii::QGauss<3>(degree + 2),
                         dealii::update_gradients | dealii::update_JxW_values);
  const unsigned n = fe.dofs_per_cell;
  std::vector<DofIndex> dofs(n);
  dealii::FullMatrix<double> local(n, n);
  Eigen::MatrixXd stiffness(n, n);
  for (const auto& cell : space_.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe.reinit(cell);
    const double coefficient = space_.inside(static_cast<unsigned>(cell->index())) ? form.inside : form.outside;
    stiffness.setZero();
    stiffness.selfadjointView<Eigen::Lower>().rankUpdate(weighted_gradients(fe), coefficient);
    for (unsigned i = 0; i < n; ++i) {
      for (unsigned j = 0; j <= i; ++j) local(i, j) = local(j, i) = stiffness(i, j);
    }
    cell->get_dof_indices(dofs);
    constraints_.distribute_local_to_global(local, dofs, matrix_);
  }
  if (form.membrane != 0.0) {
    for (const std::size_t f : faces) {
      const Eigen::MatrixXd mass =
          trace.shape().transpose() * trace.weights(static_cast<int>(f)).asDiagonal() * trace.shape();
      constraints_.distribute_local_to_global(jump_matrix(form.membrane * mass), both_sheets(trace.pairs(), f),
                                              matrix_);
    }
  }
  if (form.robin != 0.0) {
    dealii::FEFaceValues<3> face(space_.mapping, space_.element, dealii::QGauss<2>(degree + 2),
                                 dealii::update_values | dealii::update_JxW_values);
    for (const OuterFace& outer : space_.outer) {
      const auto cell = space_.cell(outer.cell);
      if (!cell->is_locally_owned()) continue;
      face.reinit(cell, outer.face);
      local = 0.0;
      for (unsigned i = 0; i < n; ++i) {
        if (!space_.element.has_support_on_face(i, outer.face)) continue;
        for (unsigned j = 0; j < n; ++j) {
          if (!space_.element.has_support_on_face(j, outer.face)) continue;
          for (unsigned q = 0; q < face.n_quadrature_points; ++q) {
            local(i, j) += form.robin * face.shape_value(i, q) * face.shape_value(j, q) * face.JxW(q);
          }
        }
      }
      cell->get_dof_indices(dofs);
      constraints_.distribute_local_to_global(local, dofs, matrix_);
    }
  }
  matrix_.compress(dealii::VectorOperation::add);
}

void ScalarSystem::assemble_preconditioner(const ScalarForm& form) {
  const SheetPairs& pairs = space_.trace->pairs();
  const auto cells = sub_cells(space_.element);
  const std::vector<std::size_t> faces = owned_faces(space_);
  const unsigned n = space_.element.n_dofs_per_cell();
  std::vector<DofIndex> dofs(n);
  std::vector<DofIndex> corners(8);

  dealii::DynamicSparsityPattern pattern(space_.dofs.n_dofs());
  for (const auto& cell : space_.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->get_dof_indices(dofs);
    for (const auto& sub : cells) {
      for (int v = 0; v < 8; ++v) corners[v] = dofs[sub[v]];
      constraints_.add_entries_local_to_global(corners, pattern, false);
    }
  }
  if (form.membrane != 0.0) {
    for (const std::size_t f : faces) {
      for (const int p : pairs.of_face[f]) {
        constraints_.add_entries_local_to_global({pairs.pairs[p][0], pairs.pairs[p][1]}, pattern, false);
      }
    }
  }
  initialise(sub_cell_matrix_, pattern, space_);

  const dealii::Quadrature<3> at_nodes(space_.element.get_unit_support_points());
  dealii::FEValues<3> fe(space_.mapping, space_.element, at_nodes, dealii::update_quadrature_points);
  dealii::FullMatrix<double> local(8, 8);
  for (const auto& cell : space_.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe.reinit(cell);
    cell->get_dof_indices(dofs);
    const double coefficient = space_.inside(static_cast<unsigned>(cell->index())) ? form.inside : form.outside;
    for (const auto& sub : cells) {
      Eigen::Matrix<double, 3, 8> vertices;
      for (int v = 0; v < 8; ++v) {
        corners[v] = dofs[sub[v]];
        for (unsigned d = 0; d < 3; ++d) vertices(d, v) = fe.quadrature_point(sub[v])[d];
      }
      const Eigen::Matrix<double, 8, 8> stiffness = coefficient * trilinear_stiffness(vertices);
      for (unsigned i = 0; i < 8; ++i) {
        for (unsigned j = 0; j < 8; ++j) local(i, j) = stiffness(i, j);
      }
      constraints_.distribute_local_to_global(local, corners, sub_cell_matrix_);
    }
  }
  // Masses on faces enter lumped: by the row sums of the exact ones.
  if (form.membrane != 0.0) {
    for (const std::size_t f : faces) {
      const Vector lumped = space_.trace->shape().transpose() * space_.trace->weights(static_cast<int>(f));
      for (Eigen::Index a = 0; a < lumped.size(); ++a) {
        const auto& pair = pairs.pairs[pairs.of_face[f][a]];
        constraints_.distribute_local_to_global(jump_matrix(Eigen::MatrixXd::Constant(1, 1, form.membrane * lumped[a])),
                                                std::vector<DofIndex>{pair[0], pair[1]}, sub_cell_matrix_);
      }
    }
  }
  if (form.robin != 0.0) {
    dealii::FEFaceValues<3> face(space_.mapping, space_.element, dealii::QGauss<2>(space_.element.degree + 2),
                                 dealii::update_values | dealii::update_JxW_values);
    for (const OuterFace& outer : space_.outer) {
      const auto cell = space_.cell(outer.cell);
      if (!cell->is_locally_owned()) continue;
      face.reinit(cell, outer.face);
      cell->get_dof_indices(dofs);
      for (unsigned i = 0; i < n; ++i) {
        if (!space_.element.has_support_on_face(i, outer.face)) continue;
        dealii::FullMatrix<double> entry(1, 1);
        for (unsigned q = 0; q < face.n_quadrature_points; ++q) {
          entry(0, 0) += form.robin * face.shape_value(i, q) * face.JxW(q);
        }
        constraints_.distribute_local_to_global(entry, std::vector<DofIndex>{dofs[i]}, sub_cell_matrix_);
      }
    }
  }
  sub_cell_matrix_.compress(dealii::VectorOperation::add);

  dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
  data.elliptic = true;
  data.aggregation_threshold = 0.02;
  data.smoother_sweeps = 3;
  preconditioner_.initialize(sub_cell_matrix_, data);
}

dealii::Vector<double> ScalarSystem::solve(const Distributed& b, double tolerance, int& iterations) const {
  Distributed x(b);
  x = 0.0;
  const double norm = b.l2_norm();
  if (!std::isfinite(norm)) throw SolveError("the right-hand side of the potential is not finite");
  dealii::SolverControl control(2000, tolerance * norm);
  if (norm > 0.0) {
    dealii::SolverCG<Distributed> solver(control);
    try {
      solver.solve(matrix_, x, b, preconditioner_);
    } catch (const dealii::SolverControl::NoConvergence& failure) {
      throw SolveError("conjugate gradients stopped after " + std::to_string(failure.last_step) +
                       " iterations at the residual " + std::to_string(failure.last_residual / norm) +
                       " relative to the start; asked for " + std::to_string(tolerance));
    }
    iterations += static_cast<int>(control.last_step());
  }
  dealii::Vector<double> result(x);
  constraints_.distribute(result);
  return result;
}

Distributed right_side(const Space& space, const dealii::DoFHandler<3>& handler) {
  return Distributed(handler.locally_owned_dofs(), space.communicator);
}

void add_stiffness_action(const Space& space, const Constraints& constraints, const ScalarForm& form, double scale,
                          const dealii::Vector<double>& u, Distributed& result) {
  dealii::FEValues<3> fe(space.mapping, space.element, dealii::QGauss<3>(space.element.degree + 2),
                         dealii::update_gradients | dealii::update_JxW_values);
  std::vector<DofIndex> dofs(fe.dofs_per_cell);
  dealii::Vector<double> local(fe.dofs_per_cell);
  Vector values(fe.dofs_per_cell);
  for (const auto& cell : space.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->get_dof_indices(dofs);
    for (unsigned i = 0; i < dofs.size(); ++i) values[i] = u[dofs[i]];
    if (values.isZero(0.0)) continue;
    fe.reinit(cell);
    const double coefficient = space.inside(static_cast<unsigned>(cell->index())) ? form.inside : form.outside;
    const Eigen::MatrixXd gradients = weighted_gradients(fe);
    const Vector action = scale * coefficient * (gradients * (gradients.transpose() * values));
    for (unsigned i = 0; i < dofs.size(); ++i) local[i] = action[i];
    constraints.distribute_local_to_global(local, dofs, result);
  }
}

void add_membrane_functionals(const Space& space, const Constraints& constraints, const Vector& inner,
                              const Vector& outer, Distributed& result) {
  const auto& pairs = space.trace->pairs().pairs;
  const dealii::IndexSet owned = space.dofs.locally_owned_dofs();
  std::vector<DofIndex> dofs;
  std::vector<double> values;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    if (!owned.is_element(pairs[p][0])) continue;
    dofs.insert(dofs.end(), {pairs[p][0], pairs[p][1]});
    values.insert(values.end(), {inner[p], outer[p]});
  }
  constraints.distribute_local_to_global(dealii::Vector<double>(values.begin(), values.end()), dofs, result);
}

void add_outer_functional(const Space& space, const Constraints& constraints,
                          const std::function<double(const Vector3&)>& f, Distributed& result) {
  dealii::FEFaceValues<3> face(space.mapping, space.element, dealii::QGauss<2>(space.element.degree + 2),
                               dealii::update_values | dealii::update_JxW_values | dealii::update_quadrature_points);
  std::vector<DofIndex> dofs(face.dofs_per_cell);
  dealii::Vector<double> local(face.dofs_per_cell);
  for (const OuterFace& outer : space.outer) {
    const auto cell = space.cell(outer.cell);
    if (!cell->is_locally_owned()) continue;
    face.reinit(cell, outer.face);
    cell->get_dof_indices(dofs);
    local = 0.0;
    for (unsigned q = 0; q < face.n_quadrature_points; ++q) {
      const auto& x = face.quadrature_point(q);
      const double weighted = f(Vector3(x[0], x[1], x[2])) * face.JxW(q);
      for (unsigned i = 0; i < dofs.size(); ++i) local[i] += weighted * face.shape_value(i, q);
    }
    constraints.distribute_local_to_global(local, dofs, result);
  }
}

Vector inner_flux_functional(const Space& space, const dealii::Vector<double>& u) {
  const std::vector<int>& index = space.trace->pairs().index_of_inner;
  dealii::FEValues<3> fe(space.mapping, space.element, dealii::QGauss<3>(space.element.degree + 2),
                         dealii::update_gradients | dealii::update_JxW_values);
  std::vector<DofIndex> dofs(fe.dofs_per_cell);
  Vector values(fe.dofs_per_cell);
  std::vector<double> sums(space.trace->size(), 0.0);
  for (const auto& cell : space.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned() || !space.inside(static_cast<unsigned>(cell->index()))) continue;
    cell->get_dof_indices(dofs);
    if (std::none_of(dofs.begin(), dofs.end(), [&](DofIndex dof) { return index[dof] >= 0; })) continue;
    fe.reinit(cell);
    for (unsigned i = 0; i < dofs.size(); ++i) values[i] = u[dofs[i]];
    const Eigen::MatrixXd gradients = weighted_gradients(fe);
    const Vector action = gradients * (gradients.transpose() * values);
    for (unsigned i = 0; i < dofs.size(); ++i) {
      if (index[dofs[i]] >= 0) sums[index[dofs[i]]] += action[i];
    }
  }
  dealii::Utilities::MPI::sum(sums, space.communicator, sums);
  return Eigen::Map<const Vector>(sums.data(), static_cast<Eigen::Index>(sums.size()));
}

}  // namespace vehd::fem_check
