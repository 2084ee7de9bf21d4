#include "fem_check/discretisation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fem_check/cell_points.hpp"
#include "fem_check/membrane_trace.hpp"

namespace vehd::fem_check {

namespace {

/// Largest distance of a unit coordinate from [0, 1].
double excess(const UnitPoint& unit) {
  double result = 0.0;
  for (unsigned d = 0; d < 3; ++d) result = std::max({result, -unit[d], unit[d] - 1.0});
  return result;
}

/// Whether a point is in the box of the cell's mapping nodes, enlarged by a tenth: curved cells bulge little beyond it.
bool near(const dealii::BoundingBox<3>& box, const dealii::Point<3>& point) {
  for (unsigned d = 0; d < 3; ++d) {
    const double margin = 0.1 * box.side_length(d);
    if (point[d] < box.lower_bound(d) - margin || point[d] > box.upper_bound(d) + margin) return false;
  }
  return true;
}

struct Candidate {
  unsigned cell = 0;
  UnitPoint unit;
  double excess = 1e-6;  ///< tolerance in unit coordinates: rounding of the inversion of the mapping
  bool found = false;
};

Candidate find_cell(const Space& space, const dealii::Point<3>& point) {
  Candidate best;
  for (unsigned c = 0; c < space.boxes.size() && !(best.found && best.excess == 0.0); ++c) {
    if (!near(space.boxes[c], point)) continue;
    try {
      const UnitPoint unit = space.mapping.transform_real_to_unit_cell(space.cell(c), point);
      const double out = excess(unit);
      if (out <= best.excess) best = {c, unit, out, true};
    } catch (const dealii::Mapping<3>::ExcTransformationFailed&) {
      // Newton's method left the neighbourhood of this cell, so the point is in another one.
    }
  }
  return best;
}

std::vector<double> even_nodes(int intervals) {
  std::vector<double> nodes;
  for (int i = 0; i <= intervals; ++i) nodes.push_back(double(i) / intervals);
  return nodes;
}

void require_positive(int count, const char* what) {
  if (count < 1) throw std::invalid_argument(std::string(what) + " is " + std::to_string(count) + "; at least 1");
}

}  // namespace

Discretisation::Discretisation(std::shared_ptr<const meshes::VolumeMesh> mesh, int degree, Ranks ranks,
                               int points_per_edge)
    : space_(std::make_shared<Space>(std::move(mesh), degree, ranks == Ranks::all ? MPI_COMM_WORLD : MPI_COMM_SELF,
                                     points_per_edge)) {}

int Discretisation::degree() const { return static_cast<int>(space_->element.degree); }
int Discretisation::n_cells() const { return static_cast<int>(space_->triangulation.n_active_cells()); }
int Discretisation::n_faces() const { return static_cast<int>(space_->membrane.size()); }
int Discretisation::points_per_edge() const { return space_->trace->points_per_edge(); }
long Discretisation::n_nodes() const { return static_cast<long>(space_->dofs.n_dofs()); }

SurfacePoints Discretisation::quadrature_points(int per_edge) const {
  require_positive(per_edge, "points per edge");
  const dealii::QGauss<1> gauss(static_cast<unsigned>(per_edge));
  std::vector<double> nodes;
  for (const auto& point : gauss.get_points()) nodes.push_back(point[0]);
  return tensor_points(*space_, nodes, gauss.get_weights());
}

SurfacePoints Discretisation::lattice_points(int intervals) const {
  require_positive(intervals, "intervals per edge");
  return tensor_points(*space_, even_nodes(intervals), {});
}

VolumePoints Discretisation::locate(const Vectors& points) const {
  VolumePoints result;
  result.position = points;
  result.unit.resize(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vector3 x = space_->dimensionless(points.col(i));
    const Candidate place = find_cell(*space_, {x.x(), x.y(), x.z()});
    if (!place.found) {
      std::ostringstream message;
      message << "the point (" << points.col(i).transpose() << ") lies in no cell of the mesh, whose outer sphere has "
              << "radius " << space_->mesh->outer_radius();
      throw LocationError(message.str());
    }
    result.cell.push_back(static_cast<int>(place.cell));
    result.inside.push_back(space_->inside(place.cell));
    result.unit.col(i) << place.unit[0], place.unit[1], place.unit[2];
  }
  return result;
}

VolumePoints Discretisation::volume_lattice(int intervals) const {
  require_positive(intervals, "intervals per edge");
  const std::vector<double> nodes = even_nodes(intervals);
  std::vector<UnitPoint> units;
  for (const double z : nodes) {
    for (const double y : nodes) {
      for (const double x : nodes) units.emplace_back(x, y, z);
    }
  }
  VolumePoints result;
  const auto per_cell = static_cast<Eigen::Index>(units.size());
  result.position.resize(3, per_cell * n_cells());
  result.unit.resize(3, per_cell * n_cells());
  CellPoints cell(*space_, space_->dofs);
  for (int c = 0; c < n_cells(); ++c) {
    cell.reinit(static_cast<unsigned>(c), units);
    result.position.middleCols(c * per_cell, per_cell) = cell.positions();
    for (Eigen::Index i = 0; i < per_cell; ++i) {
      result.unit.col(c * per_cell + i) << units[i][0], units[i][1], units[i][2];
      result.cell.push_back(c);
      result.inside.push_back(space_->inside(static_cast<unsigned>(c)));
    }
  }
  return result;
}

Vector SurfacePoints::theta() const {
  Vector result(size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    result[i] = std::atan2(direction.col(i).head<2>().norm(), direction(2, i));
  }
  return result;
}

Vector SurfacePoints::phi() const {
  Vector result(size());
  for (Eigen::Index i = 0; i < size(); ++i) result[i] = std::atan2(direction(1, i), direction(0, i));
  return result;
}

std::vector<Eigen::Index> SurfacePoints::of_vesicle(int number) const {
  std::vector<Eigen::Index> result;
  for (Eigen::Index i = 0; i < size(); ++i) {
    if (vesicle[static_cast<std::size_t>(i)] == number) result.push_back(i);
  }
  return result;
}

SurfacePoints SurfacePoints::picked(const std::vector<Eigen::Index>& numbers) const {
  SurfacePoints result;
  result.position = position(Eigen::all, numbers);
  result.normal = normal(Eigen::all, numbers);
  result.direction = direction(Eigen::all, numbers);
  result.weight = weight(numbers);
  result.face_coordinates = face_coordinates(Eigen::all, numbers);
  for (const Eigen::Index i : numbers) {
    result.face.push_back(face[i]);
    result.vesicle.push_back(vesicle[i]);
  }
  return result;
}

double relative_l2(const SurfacePoints& points, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const auto norm = [&](const Eigen::MatrixXd& field) {
    const Vector squares = field.cols() == points.size() ? Vector(field.colwise().squaredNorm().transpose())
                                                         : Vector(field.rowwise().squaredNorm());
    return std::sqrt(points.weight.dot(squares));
  };
  return norm(a - b) / norm(b);
}

double relative_max(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const auto largest = [](const Eigen::MatrixXd& field) {
    return field.cols() == 1 ? field.cwiseAbs().maxCoeff() : field.colwise().norm().maxCoeff();
  };
  return largest(a - b) / largest(b);
}

}  // namespace vehd::fem_check
