#include "fem_check/surface_terms.hpp"

namespace vehd::fem_check {

OuterSphere::OuterSphere(const Space& space, const dealii::DoFHandler<3>& handler) {
  const auto& element = handler.get_fe();
  const unsigned degree = element.degree;
  dealii::FEFaceValues<3> fe(space.mapping, element,
                             dealii::QGauss<2>(static_cast<unsigned>(points_per_direction(static_cast<int>(degree)))),
                             dealii::update_values | dealii::update_gradients | dealii::update_normal_vectors |
                                 dealii::update_JxW_values | dealii::update_quadrature_points);
  dealii::FEValues<3> at_nodes(space.mapping, element, dealii::Quadrature<3>(element.get_unit_support_points()),
                               dealii::update_quadrature_points);
  const auto as_vector = [](const auto& tensor) { return Vector3(tensor[0], tensor[1], tensor[2]); };
  std::vector<int> number(handler.n_dofs(), -1);
  std::vector<DofIndex> dofs(element.n_dofs_per_cell());
  for (const OuterFace& outer : space.outer) {
    const auto cell = space.cell(handler, outer.cell);
    fe.reinit(cell, outer.face);
    at_nodes.reinit(cell);
    cell->get_dof_indices(dofs);
    Face& face = faces_.emplace_back();
    std::vector<unsigned> local;
    for (unsigned i = 0; i < dofs.size(); ++i) {
      if (!element.has_support_on_face(i, outer.face)) continue;
      local.push_back(i);
      if (number[dofs[i]] < 0) {
        number[dofs[i]] = static_cast<int>(dofs_.size());
        dofs_.push_back(dofs[i]);
        positions_.push_back(space.physical(as_vector(at_nodes.quadrature_point(i))));
      }
      face.nodes.push_back(number[dofs[i]]);
    }
    const auto n_points = static_cast<Eigen::Index>(fe.n_quadrature_points);
    const auto n_nodes = static_cast<Eigen::Index>(local.size());
    face.value.resize(n_points, n_nodes);
    for (auto& gradient : face.gradient) gradient.resize(n_points, n_nodes);
    face.normal.resize(3, n_points);
    face.position.resize(3, n_points);
    face.weight.resize(n_points);
    for (unsigned q = 0; q < fe.n_quadrature_points; ++q) {
      face.normal.col(q) = as_vector(fe.normal_vector(q));
      face.position.col(q) = space.physical(as_vector(fe.quadrature_point(q)));
      face.weight[q] = fe.JxW(q);
      for (Eigen::Index i = 0; i < n_nodes; ++i) {
        face.value(q, i) = fe.shape_value(local[i], q);
        for (unsigned d = 0; d < 3; ++d) face.gradient[d](q, i) = fe.shape_grad(local[i], q)[d];
      }
    }
  }
  mass_ = assemble(
      [](const Face& face) { return Eigen::MatrixXd(face.value.transpose() * face.weight.asDiagonal() * face.value); });
}

template <typename Local>
Eigen::SparseMatrix<double> OuterSphere::assemble(const Local& local) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Face& face : faces_) {
    const Eigen::MatrixXd matrix = local(face);
    for (std::size_t j = 0; j < face.nodes.size(); ++j) {
      for (std::size_t i = 0; i < face.nodes.size(); ++i) {
        entries.emplace_back(face.nodes[i], face.nodes[j], matrix(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> result(size(), size());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Eigen::SparseMatrix<double> OuterSphere::rotation(unsigned a, unsigned b) const {
  return assemble([&](const Face& face) {
    const Eigen::MatrixXd derivative = face.normal.row(b).transpose().asDiagonal() * face.gradient[a] -
                                       face.normal.row(a).transpose().asDiagonal() * face.gradient[b];
    return Eigen::MatrixXd(face.value.transpose() * face.weight.asDiagonal() * derivative);
  });
}

Vector OuterSphere::integrate(const std::function<double(const Vector3&)>& f) const {
  Vector result = Vector::Zero(size());
  for (const Face& face : faces_) {
    Vector weighted = face.weight;
    for (Eigen::Index q = 0; q < weighted.size(); ++q) weighted[q] *= f(Vector3(face.position.col(q)));
    const Vector local = face.value.transpose() * weighted;
    for (std::size_t i = 0; i < face.nodes.size(); ++i) result[face.nodes[i]] += local[static_cast<Eigen::Index>(i)];
  }
  return result;
}

Eigen::MatrixXd OuterSphere::moments(const std::function<Eigen::MatrixXd(const Vectors&)>& values) const {
  Eigen::MatrixXd result;
  for (const Face& face : faces_) {
    const Eigen::MatrixXd local = face.value.transpose() * face.weight.asDiagonal() * values(face.position).transpose();
    if (result.size() == 0) result = Eigen::MatrixXd::Zero(size(), local.cols());
    for (std::size_t i = 0; i < face.nodes.size(); ++i) {
      result.row(face.nodes[i]) += local.row(static_cast<Eigen::Index>(i));
    }
  }
  return result;
}

SurfaceTerms::SurfaceTerms(const Space& space, const dealii::DoFHandler<3>& handler, const Constraints& constraints,
                           std::vector<DofIndex> dofs, Eigen::SparseMatrix<double> matrix)
    : communicator_(space.communicator), dofs_(std::move(dofs)), matrix_(std::move(matrix)) {
  const dealii::IndexSet owned = handler.locally_owned_dofs();
  for (std::size_t i = 0; i < dofs_.size(); ++i) {
    if (owned.is_element(dofs_[i]) && !constraints.is_constrained(dofs_[i])) own_.push_back(i);
  }
}

void SurfaceTerms::add(const std::vector<Distributed*>& to, const std::vector<const Distributed*>& from) const {
  if (dofs_.empty()) return;
  Vector values = Vector::Zero(matrix_.cols());
  const auto at = [&](std::size_t component, std::size_t node) {
    return static_cast<Eigen::Index>(component * dofs_.size() + node);
  };
  for (std::size_t c = 0; c < from.size(); ++c) {
    for (const std::size_t i : own_) values[at(c, i)] = (*from[c])(dofs_[i]);
  }
  const dealii::ArrayView<double> all(values.data(), static_cast<std::size_t>(values.size()));
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all), communicator_, all);
  const Vector product = matrix_ * values;
  for (std::size_t c = 0; c < to.size(); ++c) {
    for (const std::size_t i : own_) (*to[c])(dofs_[i]) += product[at(c, i)];
  }
}

void SurfaceTerms::add_diagonal(Distributed& diagonal) const {
  for (const std::size_t i : own_) {
    diagonal(dofs_[i]) += matrix_.coeff(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
  }
}

dealii::Vector<double> on_all_ranks(const Distributed& vector, MPI_Comm communicator) {
  dealii::Vector<double> result(vector.size());
  for (const DofIndex dof : vector.locally_owned_elements()) result[dof] = vector(dof);
  const dealii::ArrayView<double> all(result.begin(), result.size());
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all), communicator, all);
  return result;
}

void interpolate(const dealii::DoFHandler<3>& from, const dealii::Vector<double>& nodal,
                 const dealii::DoFHandler<3>& to_handler, const Constraints& constraints, Distributed& to) {
  const auto &source = from.get_fe(), &element = to_handler.get_fe();
  dealii::FullMatrix<double> matrix(element.n_dofs_per_cell(), source.n_dofs_per_cell());
  element.get_interpolation_matrix(source, matrix);
  dealii::Vector<double> values(source.n_dofs_per_cell()), at_nodes(element.n_dofs_per_cell());
  std::vector<DofIndex> dofs(element.n_dofs_per_cell());
  auto cell = from.begin_active();
  for (const auto& target : to_handler.active_cell_iterators()) {
    cell->get_dof_values(nodal, values);
    matrix.vmult(at_nodes, values);
    target->get_dof_indices(dofs);
    for (unsigned i = 0; i < dofs.size(); ++i) {
      if (to.locally_owned_elements().is_element(dofs[i]) && !constraints.is_constrained(dofs[i])) {
        to(dofs[i]) = at_nodes[i];
      }
    }
    ++cell;
  }
}

}  // namespace vehd::fem_check
