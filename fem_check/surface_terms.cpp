#include "fem_check/surface_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace vehd::fem_check {

namespace {

/// Point on a face of the unit cell, in deal.II's numbering.
UnitPoint on_unit_face(unsigned face, double s, double t) {
  const unsigned axis = face / 2;
  UnitPoint result;
  result[axis] = face % 2;
  result[(axis + 1) % 3] = s;
  result[(axis + 2) % 3] = t;
  return result;
}

std::vector<UnitPoint> on_unit_face(unsigned face, const Eigen::Matrix2Xd& points) {
  std::vector<UnitPoint> result;
  for (const auto point : points.colwise()) result.push_back(on_unit_face(face, point[0], point[1]));
  return result;
}

/// Numbers in the cell of the nodes on a face, as a lattice with the first coordinate fastest.
std::vector<unsigned> nodes_on(unsigned face, const dealii::FiniteElement<3>& element) {
  const std::vector<UnitPoint>& nodes = element.get_unit_support_points();
  std::vector<unsigned> result;
  for (const UnitPoint& place : on_unit_face(face, face_node_points(static_cast<int>(element.degree)))) {
    const auto found =
        std::find_if(nodes.begin(), nodes.end(), [&](const UnitPoint& node) { return node.distance(place) < 1e-9; });
    result.push_back(static_cast<unsigned>(found - nodes.begin()));
  }
  return result;
}

/// Calls visit(face, degrees of freedom on it) for each face, in the order of nodes_on(face).
template <typename Visit>
void for_each_face(const std::vector<OuterFace>& faces, const Space& space, const dealii::DoFHandler<3>& handler,
                   const Visit& visit) {
  std::map<unsigned, std::vector<unsigned>> on_face;
  std::vector<DofIndex> of_cell(handler.get_fe().n_dofs_per_cell());
  for (const OuterFace& face : faces) {
    const auto [local, is_new] = on_face.try_emplace(face.face);
    if (is_new) local->second = nodes_on(face.face, handler.get_fe());
    space.cell(handler, face.cell)->get_dof_indices(of_cell);
    std::vector<DofIndex> nodes;
    for (const unsigned i : local->second) nodes.push_back(of_cell[i]);
    visit(face, nodes);
  }
}

/// Dimensionless positions of the nodes of the geometry on a face.
Vectors geometry_nodes(const Space& space, const OuterFace& face) {
  std::vector<meshes::Point> units;
  for (const UnitPoint& unit :
       on_unit_face(face.face, face_node_points(static_cast<int>(space.mapping.get_degree())))) {
    units.push_back(space.mesh_unit(face.cell, unit));
  }
  Vectors result(3, static_cast<Eigen::Index>(units.size()));
  Eigen::Index i = 0;
  for (const meshes::Point& place : space.mesh->physical_points(static_cast<int>(face.cell), units)) {
    result.col(i++) = space.dimensionless(place);
  }
  return result;
}

}  // namespace

std::vector<DofIndex> nodes_on(const std::vector<OuterFace>& faces, const Space& space,
                               const dealii::DoFHandler<3>& handler) {
  std::set<DofIndex> result;
  for_each_face(faces, space, handler, [&](const OuterFace&, const std::vector<DofIndex>& nodes) {
    result.insert(nodes.begin(), nodes.end());
  });
  return {result.begin(), result.end()};
}

OuterSphere::OuterSphere(const Space& space, const dealii::DoFHandler<3>& handler) : space_(space), handler_(handler) {
  const auto degree = static_cast<int>(handler.get_fe().degree);
  const dealii::QGauss<2> gauss(static_cast<unsigned>(points_per_direction(degree)));
  const auto n_points = static_cast<Eigen::Index>(gauss.size());
  Eigen::Matrix2Xd rule(2, n_points);
  for (unsigned q = 0; q < gauss.size(); ++q) rule.col(q) << gauss.point(q)[0], gauss.point(q)[1];
  shape_ = face_shape(degree, rule);
  const FaceShape geometry = face_shape(static_cast<int>(space.mapping.get_degree()), rule);
  std::vector<int> number(handler.n_dofs(), -1);
  for_each_face(space.outer, space, handler, [&](const OuterFace& outer, const std::vector<DofIndex>& dofs) {
    Face& face = faces_.emplace_back();
    for (const DofIndex dof : dofs) {
      if (number[dof] < 0) {
        number[dof] = static_cast<int>(dofs_.size());
        dofs_.push_back(dof);
      }
      face.nodes.push_back(number[dof]);
    }
    const Vectors nodes = geometry_nodes(space, outer);
    const Vectors first = nodes * geometry.derivative[0].transpose(),
                  second = nodes * geometry.derivative[1].transpose();
    face.position = nodes * geometry.value.transpose();
    face.normal.resize(3, n_points);
    for (Vectors& dual : face.dual) dual.resize(3, n_points);
    face.weight.resize(n_points);
    for (Eigen::Index q = 0; q < n_points; ++q) {
      const Vector3 s = first.col(q), t = second.col(q), area = s.cross(t);
      const double square = area.squaredNorm(), size = std::sqrt(square);
      face.dual[0].col(q) = t.cross(area) / square;
      face.dual[1].col(q) = area.cross(s) / square;
      face.normal.col(q) = std::copysign(1.0 / size, area.dot(face.position.col(q))) * area;
      face.weight[q] = size * gauss.weight(static_cast<unsigned>(q));
      face.position.col(q) = space.physical(face.position.col(q));
    }
  });
  mass_ = assemble([&](const Face& face) {
    return Eigen::MatrixXd(shape_.value.transpose() * face.weight.asDiagonal() * shape_.value);
  });
}

Vectors OuterSphere::positions() const {
  const Eigen::MatrixXd value = face_shape(static_cast<int>(space_.mapping.get_degree()),
                                           face_node_points(static_cast<int>(handler_.get_fe().degree)))
                                    .value;
  Vectors result(3, size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Vectors at_nodes = geometry_nodes(space_, space_.outer[f]) * value.transpose();
    for (std::size_t i = 0; i < faces_[f].nodes.size(); ++i) {
      result.col(faces_[f].nodes[i]) = space_.physical(at_nodes.col(static_cast<Eigen::Index>(i)));
    }
  }
  return result;
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
  const Eigen::SparseMatrix<double> all = assemble([&](const Face& face) {
    Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(shape_.value.rows(), shape_.value.cols());
    for (std::size_t k = 0; k < face.dual.size(); ++k) {
      const auto factor =
          face.normal.row(b).cwiseProduct(face.dual[k].row(a)) - face.normal.row(a).cwiseProduct(face.dual[k].row(b));
      derivative += factor.transpose().asDiagonal() * shape_.derivative[k];
    }
    return Eigen::MatrixXd(shape_.value.transpose() * face.weight.asDiagonal() * derivative);
  });
  return 0.5 * (all - Eigen::SparseMatrix<double>(all.transpose()));
}

Vector OuterSphere::integrate(const std::function<double(const Vector3&)>& f) const {
  Vector result = Vector::Zero(size());
  for (const Face& face : faces_) {
    Vector weighted = face.weight;
    for (Eigen::Index q = 0; q < weighted.size(); ++q) weighted[q] *= f(Vector3(face.position.col(q)));
    const Vector local = shape_.value.transpose() * weighted;
    for (std::size_t i = 0; i < face.nodes.size(); ++i) result[face.nodes[i]] += local[static_cast<Eigen::Index>(i)];
  }
  return result;
}

Eigen::MatrixXd OuterSphere::moments(const std::function<Eigen::MatrixXd(const Vectors&)>& values) const {
  Eigen::MatrixXd result;
  for (const Face& face : faces_) {
    const Eigen::MatrixXd local =
        shape_.value.transpose() * face.weight.asDiagonal() * values(face.position).transpose();
    if (result.size() == 0) result = Eigen::MatrixXd::Zero(size(), local.cols());
    for (std::size_t i = 0; i < face.nodes.size(); ++i) {
      result.row(face.nodes[i]) += local.row(static_cast<Eigen::Index>(i));
    }
  }
  return result;
}

SurfaceTerms::SurfaceTerms(const Space& space, const dealii::DoFHandler<3>& handler, const Constraints& constraints,
                           std::vector<DofIndex> dofs, Eigen::SparseMatrix<double> matrix,
                           std::vector<ComponentCoupling> couplings)
    : communicator_(space.communicator), dofs_(std::move(dofs)), matrix_(std::move(matrix)) {
  const dealii::IndexSet owned = handler.locally_owned_dofs();
  for (std::size_t i = 0; i < dofs_.size(); ++i) {
    if (owned.is_element(dofs_[i]) && !constraints.is_constrained(dofs_[i])) own_.push_back(i);
  }
  for (ComponentCoupling& coupling : couplings) {
    couplings_.push_back({coupling.first, coupling.second, coupling.matrix.transpose()});
    couplings_.push_back({coupling.second, coupling.first, std::move(coupling.matrix)});
  }
}

namespace {

/// Product of a column and a vector. Uses four partial sums, as additions to a single one would wait for each other.
double column_times(const Eigen::SparseMatrix<double>& matrix, Eigen::Index column, const double* x) {
  constexpr int n_sums = 4;
  const double* values = matrix.valuePtr();
  const int* rows = matrix.innerIndexPtr();
  Eigen::Index i = matrix.outerIndexPtr()[column];
  const Eigen::Index end = matrix.outerIndexPtr()[column + 1];
  std::array<double, n_sums> sums{};
  for (; i + n_sums <= end; i += n_sums) {
    for (int k = 0; k < n_sums; ++k) sums[k] += values[i + k] * x[rows[i + k]];
  }
  for (; i < end; ++i) sums[0] += values[i] * x[rows[i]];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

void SurfaceTerms::add(const std::vector<Distributed*>& to, const std::vector<const Distributed*>& from) const {
  if (dofs_.empty()) return;
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(matrix_.cols(), static_cast<Eigen::Index>(from.size()));
  for (std::size_t c = 0; c < from.size(); ++c) {
    for (const std::size_t i : own_) {
      values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = (*from[c])(dofs_[i]);
    }
  }
  const dealii::ArrayView<double> all(values.data(), static_cast<std::size_t>(values.size()));
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all), communicator_, all);
  for (const std::size_t i : own_) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t c = 0; c < to.size(); ++c) {
      // In a symmetric matrix, columns are rows.
      (*to[c])(dofs_[i]) += column_times(matrix_, row, values.col(static_cast<Eigen::Index>(c)).data());
    }
    for (const OneWay& coupling : couplings_) {
      (*to[coupling.to])(dofs_[i]) += column_times(coupling.transposed, row, values.col(coupling.from).data());
    }
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

namespace {

/// Nodal functions of one degree along an edge at the nodes of another one: [nodes x functions].
Eigen::MatrixXd at_edge_nodes(unsigned degree, unsigned degree_of_nodes) {
  const auto line = edge_polynomials(degree);
  const std::vector<double> nodes = edge_nodes(degree_of_nodes);
  Eigen::MatrixXd result(nodes.size(), line.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < line.size(); ++j) {
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = line[j].value(nodes[i]);
    }
  }
  return result;
}

}  // namespace

void interpolate(const dealii::DoFHandler<3>& from, const dealii::Vector<double>& nodal,
                 const dealii::DoFHandler<3>& to_handler, const Constraints& constraints, Distributed& to) {
  const unsigned degree_from = from.get_fe().degree, degree_to = to_handler.get_fe().degree;
  const Eigen::MatrixXd along_edge = at_edge_nodes(degree_from, degree_to);
  const Eigen::Index n = along_edge.rows(), m = along_edge.cols();
  // Lexicographic numbering, first coordinate fastest.
  const auto numbers_from = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(degree_from),
             numbers_to = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(degree_to);
  dealii::Vector<double> values(from.get_fe().n_dofs_per_cell());
  std::vector<DofIndex> dofs(to_handler.get_fe().n_dofs_per_cell());
  Eigen::MatrixXd lattice(m, m * m), first(n, m * m), second(n * n, m), at_nodes(n * n, n);
  auto cell = from.begin_active();
  for (const auto& target : to_handler.active_cell_iterators()) {
    cell->get_dof_values(nodal, values);
    for (unsigned i = 0; i < values.size(); ++i) lattice.data()[i] = values[numbers_from[i]];
    first.noalias() = along_edge * lattice;
    for (Eigen::Index k = 0; k < m; ++k) {
      second.col(k).reshaped(n, n).noalias() = first.middleCols(k * m, m) * along_edge.transpose();
    }
    at_nodes.noalias() = second * along_edge.transpose();
    target->get_dof_indices(dofs);
    for (unsigned i = 0; i < dofs.size(); ++i) {
      const DofIndex dof = dofs[numbers_to[i]];
      if (to.locally_owned_elements().is_element(dof) && !constraints.is_constrained(dof)) to(dof) = at_nodes.data()[i];
    }
    ++cell;
  }
}

}  // namespace vehd::fem_check
