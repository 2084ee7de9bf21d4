#include "fem_check/rigid_part.hpp"

#include <algorithm>
#include <cmath>

#include "fem_check/membrane_trace.hpp"

namespace vehd::fem_check {

std::vector<Vector3> node_places(const Space& space) {
  std::vector<Vector3> result(space.dofs.n_dofs(), Vector3::Zero());
  dealii::FEValues<3> fe(space.mapping, space.element, dealii::Quadrature<3>(space.element.get_unit_support_points()),
                         dealii::update_quadrature_points);
  std::vector<DofIndex> dofs(fe.dofs_per_cell);
  for (const auto& cell : space.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe.reinit(cell);
    cell->get_dof_indices(dofs);
    for (unsigned i = 0; i < dofs.size(); ++i) {
      const auto& x = fe.quadrature_point(i);
      result[dofs[i]] = Vector3(x[0], x[1], x[2]);
    }
  }
  return result;
}

RigidPart rigid_in_a_sphere(const Space& space, const std::vector<Vector3>& places) {
  double reach = 0.0;
  const Vectors& nodes = space.trace->nodes().position;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    reach = std::max(reach, space.dimensionless(nodes.col(i)).norm());
  }
  RigidPart result;
  for (const Vector3& x : places) result.share.push_back(std::pow(std::min(1.0, reach / x.norm()), 3));
  return result;
}

RigidPart rigid_in_cells(const Space& space, int vesicle) {
  RigidPart result{std::vector<double>(space.dofs.n_dofs(), 0.0), Vector3::Zero()};
  std::vector<bool> on_membrane(space.triangulation.n_vertices(), false);
  int n_corners = 0;
  for (const MembraneFace& face : space.membrane) {
    if (face.vesicle != vesicle) continue;
    const auto cell = space.cell(face.outer_cell);
    for (const UnitPoint& corner : face.outer_corners) {
      const unsigned vertex = static_cast<unsigned>(corner[0] + 2.0 * corner[1] + 4.0 * corner[2] + 0.5);
      on_membrane[cell->vertex_index(vertex)] = true;
      const UnitPoint& x = cell->vertex(vertex);
      result.centre += Vector3(x[0], x[1], x[2]);
      ++n_corners;
    }
  }
  result.centre /= n_corners;
  const auto& nodes = space.element.get_unit_support_points();
  std::vector<DofIndex> dofs(nodes.size());
  for (const auto& cell : space.dofs.active_cell_iterators()) {
    const auto index = static_cast<unsigned>(cell->index());
    if (space.vesicle(index) != vesicle) continue;
    cell->get_dof_indices(dofs);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      double share = space.inside(index) ? 1.0 : 0.0;
      for (unsigned v = 0; v < 8 && !space.inside(index); ++v) {
        if (!on_membrane[cell->vertex_index(v)]) continue;
        share += dealii::GeometryInfo<3>::d_linear_shape_function(nodes[i], v);
      }
      result.share[dofs[i]] = share;
    }
  }
  return result;
}

}  // namespace vehd::fem_check
