#pragma once

#include <optional>

#include "fem_check/space.hpp"
#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// Nodal functions of one degree on the unit cell at points of one of its faces. What lies behind the face counts by
/// its slope across it alone, so that sums run over the nodes of the face.
class FaceSums {
 public:
  explicit FaceSums(int degree);

  /// Goes to points of a face in deal.II's numbering, [2 x points]: the two coordinates after its own, in turn.
  void reinit(unsigned face, const Eigen::Matrix2Xd& points);
  /// At the points, [components x points].
  struct Fields {
    Eigen::MatrixXd value;
    std::array<Eigen::MatrixXd, 3> derivative;  ///< by the unit coordinates
  };
  /// @param nodal  [components x nodes of the cell], deal.II's order
  [[nodiscard]] Fields operator()(const Eigen::MatrixXd& nodal) const;

 private:
  struct Known {
    Eigen::Matrix2Xd points;
    FaceShape shape;
  };

  int n_line_;
  std::vector<unsigned> number_;     // of the node at each place of the lattice, first coordinate fastest
  std::array<Vector, 2> end_slope_;  // derivatives of the functions of a line at its ends
  std::vector<Known> known_;         // cells lie at a face in few ways
  std::size_t now_ = 0;              // of these
  unsigned face_ = 0;
};

/// Geometry and fields of one cell at given unit points, by sums over one direction after the other. Places and
/// gradients as users know them.
class CellPoints {
 public:
  CellPoints(const Space& space, const dealii::DoFHandler<3>& handler);

  /// Goes to points of a cell; several times faster where all lie on one face.
  void reinit(unsigned cell, const std::vector<UnitPoint>& units);
  [[nodiscard]] Vectors positions() const;                   ///< [3 x n_points]
  [[nodiscard]] Matrix3 jacobian(Eigen::Index point) const;  ///< ∂x/∂unit
  /// A field at the points, [n_points], from its nodal values on all ranks.
  [[nodiscard]] Vector values(const dealii::Vector<double>& nodal);
  /// Its gradient there, [3 x n_points].
  [[nodiscard]] Vectors gradients(const dealii::Vector<double>& nodal);

 private:
  void evaluate(const dealii::Vector<double>& nodal, dealii::EvaluationFlags::EvaluationFlags what);
  [[nodiscard]] FaceSums::Fields on_face(const dealii::Vector<double>& nodal) const;

  const Space& space_;
  const dealii::DoFHandler<3>& handler_;
  dealii::FEPointEvaluation<1, 3> evaluation_;
  FaceSums of_geometry_, of_fields_;
  std::optional<FaceSums::Fields> geometry_;  // where the points lie on one face; without unit
  std::vector<DofIndex> dofs_;
  std::vector<double> local_;
  std::size_t n_points_ = 0;
};

}  // namespace vehd::fem_check
