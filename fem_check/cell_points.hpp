#pragma once

#include <optional>

#include "fem_check/space.hpp"
#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// Evaluates nodal functions of one degree on the unit cell at points of one of its faces. Nodes off the face
/// contribute only to the derivative across it, so that the sums run over the nodes of the face.
class FaceSums {
 public:
  explicit FaceSums(int degree);

  /// Selects a face in deal.II's numbering, and points [2 x points]: the two coordinates after its axis, cyclically.
  void reinit(unsigned face, const Eigen::Matrix2Xd& points);
  /// Values and derivatives at the points, [components x points].
  struct Fields {
    Eigen::MatrixXd value;
    std::array<Eigen::MatrixXd, 3> derivative;  ///< with respect to the unit coordinates
  };
  /// @param nodal  [components x nodes of the cell], in deal.II's order
  [[nodiscard]] Fields operator()(const Eigen::MatrixXd& nodal) const;

 private:
  struct Known {
    Eigen::Matrix2Xd points;
    FaceShape shape;
  };

  int n_line_;
  std::vector<unsigned> number_;     // of the node at each lattice position, first coordinate fastest
  std::array<Vector, 2> end_slope_;  // derivatives of the nodal functions of a line at its ends
  std::vector<Known> known_;         // few sets of points occur
  std::size_t selected_ = 0;         // index of the selected one
  unsigned face_ = 0;
};

/// Geometry and fields of one cell at given unit points, by sum factorisation. Positions and gradients are in the
/// user's units.
class CellPoints {
 public:
  CellPoints(const Space& space, const dealii::DoFHandler<3>& handler);

  /// Selects a cell and points in it; several times faster if all points lie on one face.
  void reinit(unsigned cell, const std::vector<UnitPoint>& units);
  [[nodiscard]] Vectors positions() const;                   ///< [3 x n_points]
  [[nodiscard]] Matrix3 jacobian(Eigen::Index point) const;  ///< ∂x/∂unit
  /// Values of a field at the points, [n_points], from its nodal values on all ranks.
  [[nodiscard]] Vector values(const dealii::Vector<double>& nodal);
  /// Gradient of a field at the points, [3 x n_points].
  [[nodiscard]] Vectors gradients(const dealii::Vector<double>& nodal);

 private:
  void evaluate(const dealii::Vector<double>& nodal, dealii::EvaluationFlags::EvaluationFlags what);
  [[nodiscard]] FaceSums::Fields on_face(const dealii::Vector<double>& nodal) const;

  const Space& space_;
  const dealii::DoFHandler<3>& handler_;
  dealii::FEPointEvaluation<1, 3> evaluation_;
  FaceSums of_geometry_, of_fields_;
  std::optional<FaceSums::Fields> geometry_;  // if all points lie on one face; dimensionless
  std::vector<DofIndex> dofs_;
  std::vector<double> local_;
  std::size_t n_points_ = 0;
};

}  // namespace vehd::fem_check
