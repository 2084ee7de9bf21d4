#include "fem_check/cell_points.hpp"

#include <algorithm>
#include <cmath>

namespace vehd::fem_check {
namespace {

/// Face that contains all points up to rounding, if there is one.
std::optional<unsigned> common_face(const std::vector<UnitPoint>& units) {
  for (unsigned face = 0; face < 6 && !units.empty(); ++face) {
    const auto lies_on = [&](const UnitPoint& unit) { return std::abs(unit[face / 2] - face % 2) < 1e-12; };
    if (std::all_of(units.begin(), units.end(), lies_on)) return face;
  }
  return {};
}

Eigen::Matrix2Xd face_coordinates(unsigned face, const std::vector<UnitPoint>& units) {
  Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(units.size()));
  for (std::size_t i = 0; i < units.size(); ++i) {
    result.col(static_cast<Eigen::Index>(i)) << units[i][(face / 2 + 1) % 3], units[i][(face / 2 + 2) % 3];
  }
  return result;
}

}  // namespace

FaceSums::FaceSums(int degree)
    : n_line_(degree + 1),
      number_(dealii::FETools::lexicographic_to_hierarchic_numbering<3>(static_cast<unsigned>(degree))) {
  const auto line = edge_polynomials(static_cast<unsigned>(degree));
  std::vector<double> derivatives(2);
  for (std::size_t end = 0; end < 2; ++end) {
    end_slope_[end].resize(n_line_);
    for (int i = 0; i < n_line_; ++i) {
      line[static_cast<std::size_t>(i)].value(static_cast<double>(end), derivatives);
      end_slope_[end][i] = derivatives[1];
    }
  }
}

void FaceSums::reinit(unsigned face, const Eigen::Matrix2Xd& points) {
  face_ = face;
  const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& known) {
    return known.points.cols() == points.cols() && known.points == points;
  });
  selected_ = static_cast<std::size_t>(found - known_.begin());
  if (found == known_.end()) known_.push_back({points, face_shape(n_line_ - 1, points)});
}

FaceSums::Fields FaceSums::operator()(const Eigen::MatrixXd& nodal) const {
  const unsigned axis = face_ / 2, end = face_ % 2;
  const std::array<int, 3> stride{1, n_line_, n_line_ * n_line_};
  const int across = stride[axis], first = stride[(axis + 1) % 3], second = stride[(axis + 2) % 3];
  const int at_end = end == 0 ? 0 : n_line_ - 1;
  const Eigen::Index n_nodes = Eigen::Index{n_line_} * n_line_;
  Eigen::MatrixXd value(nodal.rows(), n_nodes), slope = Eigen::MatrixXd::Zero(nodal.rows(), n_nodes);
  Eigen::Index node = 0;
  for (int j = 0; j < n_line_; ++j) {
    for (int i = 0; i < n_line_; ++i, ++node) {
      const auto number = [&](int l) { return number_[static_cast<std::size_t>(i * first + j * second + l * across)]; };
      value.col(node) = nodal.col(number(at_end));
      for (int l = 0; l < n_line_; ++l) slope.col(node) += end_slope_[end][l] * nodal.col(number(l));
    }
  }
  const FaceShape& shape = known_[selected_].shape;
  Fields result;
  result.value = value * shape.value.transpose();
  result.derivative[axis] = slope * shape.value.transpose();
  for (unsigned k = 0; k < 2; ++k) result.derivative[(axis + 1 + k) % 3] = value * shape.derivative[k].transpose();
  return result;
}

CellPoints::CellPoints(const Space& space, const dealii::DoFHandler<3>& handler)
    : space_(space),
      handler_(handler),
      evaluation_(space.mapping, handler.get_fe(),
                  dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
                      dealii::update_jacobians | dealii::update_inverse_jacobians),
      of_geometry_(static_cast<int>(space.mapping.get_degree())),
      of_fields_(static_cast<int>(handler.get_fe().degree)),
      dofs_(handler.get_fe().n_dofs_per_cell()),
      local_(dofs_.size()) {}

void CellPoints::reinit(unsigned cell, const std::vector<UnitPoint>& units) {
  const auto iterator = space_.cell(handler_, cell);
  iterator->get_dof_indices(dofs_);
  n_points_ = units.size();
  geometry_.reset();
  if (const std::optional<unsigned> face = common_face(units)) {
    const Eigen::Matrix2Xd points = face_coordinates(*face, units);
    of_geometry_.reinit(*face, points);
    of_fields_.reinit(*face, points);
    geometry_ = of_geometry_(space_.mapping_nodes[cell]);
  } else {
    evaluation_.reinit(iterator, dealii::ArrayView<const UnitPoint>(units.data(), units.size()));
  }
}

Vectors CellPoints::positions() const {
  Vectors result(3, static_cast<Eigen::Index>(n_points_));
  for (unsigned q = 0; q < n_points_; ++q) {
    if (geometry_) {
      result.col(q) = space_.physical(geometry_->value.col(q));
    } else {
      const UnitPoint place = evaluation_.real_point(q);
      result.col(q) = space_.physical(Vector3(place[0], place[1], place[2]));
    }
  }
  return result;
}

Matrix3 CellPoints::jacobian(Eigen::Index point) const {
  Matrix3 result;
  if (geometry_) {
    for (Eigen::Index e = 0; e < 3; ++e) {
      result.col(e) = space_.length * geometry_->derivative[static_cast<std::size_t>(e)].col(point);
    }
    return result;
  }
  const auto derivative = evaluation_.jacobian(static_cast<unsigned>(point));
  for (unsigned d = 0; d < 3; ++d) {
    for (unsigned e = 0; e < 3; ++e) result(d, e) = space_.length * derivative[d][e];
  }
  return result;
}

void CellPoints::evaluate(const dealii::Vector<double>& nodal, dealii::EvaluationFlags::EvaluationFlags what) {
  for (std::size_t i = 0; i < dofs_.size(); ++i) local_[i] = nodal[dofs_[i]];
  evaluation_.evaluate(dealii::ArrayView<const double>(local_.data(), local_.size()), what);
}

FaceSums::Fields CellPoints::on_face(const dealii::Vector<double>& nodal) const {
  Eigen::MatrixXd local(1, static_cast<Eigen::Index>(dofs_.size()));
  for (std::size_t i = 0; i < dofs_.size(); ++i) local(0, static_cast<Eigen::Index>(i)) = nodal[dofs_[i]];
  return of_fields_(local);
}

Vector CellPoints::values(const dealii::Vector<double>& nodal) {
  if (geometry_) return on_face(nodal).value.transpose();
  evaluate(nodal, dealii::EvaluationFlags::values);
  Vector result(static_cast<Eigen::Index>(n_points_));
  for (unsigned q = 0; q < n_points_; ++q) result[q] = evaluation_.get_value(q);
  return result;
}

Vectors CellPoints::gradients(const dealii::Vector<double>& nodal) {
  Vectors result(3, static_cast<Eigen::Index>(n_points_));
  if (geometry_) {
    const FaceSums::Fields fields = on_face(nodal);
    for (Eigen::Index q = 0; q < result.cols(); ++q) {
      const Vector3 by_unit(fields.derivative[0](0, q), fields.derivative[1](0, q), fields.derivative[2](0, q));
      result.col(q) = jacobian(q).transpose().inverse() * by_unit;
    }
    return result;
  }
  evaluate(nodal, dealii::EvaluationFlags::gradients);
  for (unsigned q = 0; q < n_points_; ++q) {
    const auto& gradient = evaluation_.get_gradient(q);
    result.col(q) = Vector3(gradient[0], gradient[1], gradient[2]) / space_.length;
  }
  return result;
}

}  // namespace vehd::fem_check
