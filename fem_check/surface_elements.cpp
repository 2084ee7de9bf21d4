#include "fem_check/surface_elements.hpp"

#include <cmath>
#include <compare>
#include <map>
#include <string>

#include "fem_check/space.hpp"

namespace vehd::fem_check {

namespace {

using meshes::CellShape;

/// Unit point of the inner cell at given face coordinates.
meshes::Point inner_unit(const meshes::InterfacePair& pair, double s, double t) {
  const auto& vertices = meshes::face_vertices(CellShape::hexahedron, pair.inside_face);
  const auto corner = [&](int k) { return meshes::unit_vertex(CellShape::hexahedron, vertices[k]); };
  return (1 - s) * (1 - t) * corner(0) + s * (1 - t) * corner(1) + (1 - s) * t * corner(2) + s * t * corner(3);
}

/// +1 if t_1 × t_2 of a face points outwards, otherwise −1.
double orientation(const meshes::VolumeMesh& mesh, const meshes::InterfacePair& pair) {
  const meshes::Point middle = inner_unit(pair, 0.5, 0.5);
  const Matrix3 jacobian = mesh.jacobian(pair.inside_cell, middle);
  const auto image = [&](const meshes::Point& unit) { return Vector3(jacobian * unit); };
  const Vector3 first = image(inner_unit(pair, 1.0, 0.0) - inner_unit(pair, 0.0, 0.0));
  const Vector3 second = image(inner_unit(pair, 0.0, 1.0) - inner_unit(pair, 0.0, 0.0));
  return first.cross(second).dot(image(middle - meshes::Point::Constant(0.5))) > 0.0 ? 1.0 : -1.0;
}

/// Identifies a shared node: a vertex, or a position on an edge counted from its vertex with the lower number.
struct SharedPlace {
  int low, high, step;
  auto operator<=>(const SharedPlace&) const = default;
};

SharedPlace on_edge(int from, int to, int step, int degree) {
  if (step == 0) return {from, from, 0};
  if (step == degree) return {to, to, 0};
  return from < to ? SharedPlace{from, to, step} : SharedPlace{to, from, degree - step};
}

}  // namespace

FaceNodes::FaceNodes(const meshes::VolumeMesh& mesh, int degree) : degree_(degree) {
  if (degree < 1) throw std::invalid_argument("degree on the membrane is " + std::to_string(degree) + "; at least 1");
  if (mesh.cell_shape() != CellShape::hexahedron) {
    throw std::invalid_argument("the mesh has tetrahedra; elements on the membrane are quadrilaterals");
  }
  std::map<SharedPlace, int> shared;
  int next = 0;
  for (const meshes::InterfacePair& pair : mesh.interface()) {
    const auto& local = meshes::face_vertices(CellShape::hexahedron, pair.inside_face);
    const auto corner = [&](int k) { return mesh.cell(pair.inside_cell).vertices[local[k]]; };
    std::vector<int>& numbers = of_face_.emplace_back();
    vesicle_.push_back(mesh.cell(pair.inside_cell).vesicle);
    for (int j = 0; j <= degree; ++j) {
      for (int i = 0; i <= degree; ++i) {
        const bool inner = i > 0 && i < degree && j > 0 && j < degree;
        const auto place = [&] {
          if (j == 0) return on_edge(corner(0), corner(1), i, degree);
          if (j == degree) return on_edge(corner(2), corner(3), i, degree);
          return i == 0 ? on_edge(corner(0), corner(2), j, degree) : on_edge(corner(1), corner(3), j, degree);
        };
        if (inner) {
          numbers.push_back(next++);
        } else {
          const auto [entry, is_new] = shared.try_emplace(place(), next);
          if (is_new) ++next;
          numbers.push_back(entry->second);
        }
      }
    }
  }
  size_ = next;
}

FaceShape face_shape(int degree, const Eigen::Matrix2Xd& points) {
  // Tensor products of polynomials in one coordinate.
  const auto line = edge_polynomials(static_cast<unsigned>(degree));
  const auto n_line = static_cast<Eigen::Index>(line.size()), n = n_line * n_line;
  FaceShape result{Eigen::MatrixXd(points.cols(), n),
                   {Eigen::MatrixXd(points.cols(), n), Eigen::MatrixXd(points.cols(), n)}};
  Eigen::Matrix2Xd value(2, n_line), slope(2, n_line);
  std::vector<double> derivatives(2);
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    for (Eigen::Index i = 0; i < n_line; ++i) {
      for (Eigen::Index a = 0; a < 2; ++a) {
        line[static_cast<std::size_t>(i)].value(points(a, q), derivatives);
        value(a, i) = derivatives[0];
        slope(a, i) = derivatives[1];
      }
    }
    for (Eigen::Index j = 0; j < n_line; ++j) {
      result.value.row(q).segment(j * n_line, n_line) = value(1, j) * value.row(0);
      result.derivative[0].row(q).segment(j * n_line, n_line) = value(1, j) * slope.row(0);
      result.derivative[1].row(q).segment(j * n_line, n_line) = slope(1, j) * value.row(0);
    }
  }
  return result;
}

Eigen::Matrix2Xd face_node_points(int degree) {
  const dealii::FE_DGQ<2> element(static_cast<unsigned>(degree));
  const std::vector<dealii::Point<2>>& points = element.get_unit_support_points();
  Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.col(static_cast<Eigen::Index>(i)) << points[i][0], points[i][1];
  }
  return result;
}

SurfaceElements::SurfaceElements(const meshes::VolumeMesh& mesh, int degree, int points_per_edge)
    : nodes_(mesh, degree) {
  const dealii::QGauss<2> gauss(static_cast<unsigned>(points_per_edge));
  rule_.resize(2, gauss.size());
  rule_weight_.resize(gauss.size());
  for (unsigned q = 0; q < gauss.size(); ++q) {
    rule_.col(q) << gauss.point(q)[0], gauss.point(q)[1];
    rule_weight_[q] = gauss.weight(q);
  }
  shape_ = face_shape(degree, rule_);
  const Eigen::Matrix2Xd lattice = face_node_points(degree);
  positions_.resize(3, nodes_.size());
  for (int f = 0; f < nodes_.n_faces(); ++f) {
    const meshes::InterfacePair& pair = mesh.interface()[f];
    std::vector<meshes::Point> units;
    for (Eigen::Index i = 0; i < lattice.cols(); ++i) units.push_back(inner_unit(pair, lattice(0, i), lattice(1, i)));
    const std::vector<meshes::Point> points = mesh.physical_points(pair.inside_cell, units);
    for (std::size_t i = 0; i < points.size(); ++i) positions_.col(nodes_.of_face(f)[i]) = points[i];
    orientation_.push_back(orientation(mesh, pair));
  }
}

FacePatch SurfaceElements::patch(int face, const Vectors& positions) const {
  const Vectors local = at_nodes(positions, nodes_.of_face(face));
  FacePatch result;
  for (int a = 0; a < 2; ++a) result.tangent[a] = local * shape_.derivative[a].transpose();
  const Eigen::Index n = rule_.cols();
  result.dual = {Vectors(3, n), Vectors(3, n)};
  result.normal.resize(3, n);
  result.weight.resize(n);
  for (Eigen::Index q = 0; q < n; ++q) {
    const Vector3 first = result.tangent[0].col(q);
    const Vector3 second = result.tangent[1].col(q);
    const Vector3 area = first.cross(second);
    const double square = area.squaredNorm();
    result.dual[0].col(q) = second.cross(area) / square;
    result.dual[1].col(q) = area.cross(first) / square;
    result.normal.col(q) = orientation_[face] / std::sqrt(square) * area;
    result.weight[q] = std::sqrt(square) * rule_weight_[q];
  }
  return result;
}

Vectors at_nodes(const Vectors& nodal, const std::vector<int>& of_face) { return nodal(Eigen::all, of_face); }

Eigen::MatrixXd values_at(const Eigen::MatrixXd& nodal, const FaceNodes& nodes, const SurfacePoints& points) {
  Eigen::MatrixXd result(nodal.rows(), points.size());
  for (const FaceRun& run : face_runs(points)) {
    const Eigen::MatrixXd value =
        face_shape(nodes.degree(), points.face_coordinates.middleCols(run.begin, run.size)).value;
    result.middleCols(run.begin, run.size) = nodal(Eigen::all, nodes.of_face(run.face)) * value.transpose();
  }
  return result;
}

void add_to_nodes(const Eigen::MatrixXd& local, const std::vector<int>& of_face, Eigen::Ref<Vectors> nodal) {
  for (std::size_t i = 0; i < of_face.size(); ++i) nodal.col(of_face[i]) += local.col(static_cast<Eigen::Index>(i));
}

Vector interpolated(const Vector& nodal, const FaceNodes& from, const FaceNodes& to) {
  const Eigen::MatrixXd value = face_shape(from.degree(), face_node_points(to.degree())).value;
  Vector result(to.size());
  for (int f = 0; f < to.n_faces(); ++f) result(to.of_face(f)) = value * nodal(from.of_face(f));
  return result;
}

}  // namespace vehd::fem_check
