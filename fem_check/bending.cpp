#include "fem_check/bending.hpp"

#include <string>

#include "fem_check/membrane_trace.hpp"
#include "fem_check/surface_projection.hpp"

namespace vehd::fem_check {

namespace {

int required_degree(int degree) {
  if (degree < 2) {
    throw std::invalid_argument("the degree of the bending elements must be at least 2, not " + std::to_string(degree));
  }
  return degree;
}

/// ∇_γ·u at the points of a patch, from ∂u/∂s_a.
Vector surface_divergence(const FacePatch& patch, const std::array<Vectors, 2>& slope) {
  return (patch.dual[0].cwiseProduct(slope[0]) + patch.dual[1].cwiseProduct(slope[1])).colwise().sum().transpose();
}

}  // namespace

BendingElements::BendingElements(const meshes::VolumeMesh& mesh, int degree)
    : surface_(mesh, required_degree(degree), degree + 2) {}

namespace {

/// −∫ ∇_γ x:∇_γ w dA.
Vectors curvature_functional(const SurfaceElements& surface, const Vectors& positions) {
  Vectors result = Vectors::Zero(3, positions.cols());
  for (int f = 0; f < surface.nodes().n_faces(); ++f) {
    const FacePatch patch = surface.patch(f, positions);
    // ∇_γ x is the projection onto the tangent plane, which leaves ∇_γ w = tᵃ ∂w/∂s_a unchanged.
    for (int a = 0; a < 2; ++a) {
      add_to_nodes(-patch.dual[a] * patch.weight.asDiagonal() * surface.shape().derivative[a],
                   surface.nodes().of_face(f), result);
    }
  }
  return result;
}

/// ∫ n·w dA.
Vectors normal_functional(const SurfaceElements& surface, const Vectors& positions) {
  Vectors result = Vectors::Zero(3, positions.cols());
  for (int f = 0; f < surface.nodes().n_faces(); ++f) {
    const FacePatch patch = surface.patch(f, positions);
    add_to_nodes(patch.normal * patch.weight.asDiagonal() * surface.shape().value, surface.nodes().of_face(f), result);
  }
  return result;
}

}  // namespace

Vectors BendingElements::curvature_vector(const Vectors& positions) const {
  return SurfaceProjection(surface_, positions, surface_.nodes()).solve(curvature_functional(surface_, positions));
}

double BendingElements::energy(const PerVesicle<BendingEnergy>& energy, const Vectors& positions) const {
  const Vectors h = curvature_vector(positions);
  double result = 0.0;
  for (int f = 0; f < surface_.nodes().n_faces(); ++f) {
    const FacePatch patch = surface_.patch(f, positions);
    const auto [kappa, c] = energy[surface_.nodes().vesicle(f)];
    const Vectors excess =
        at_nodes(h, surface_.nodes().of_face(f)) * surface_.shape().value.transpose() - 2.0 * c * patch.normal;
    result += 0.25 * kappa * excess.colwise().squaredNorm().dot(patch.weight);
  }
  return result;
}

Vectors BendingElements::force_functional(const PerVesicle<BendingEnergy>& energy, const Vectors& positions) const {
  const SurfaceProjection projection(surface_, positions, surface_.nodes());
  const Vectors h = projection.solve(curvature_functional(surface_, positions));
  // Multiplier of the equation of h: with it, h can be kept fixed in the variation of the surface.
  Vector modulus(positions.cols()), modulus_by_curvature(positions.cols());
  for (int f = 0; f < surface_.nodes().n_faces(); ++f) {
    const auto [kappa, c] = energy[surface_.nodes().vesicle(f)];
    for (const int node : surface_.nodes().of_face(f)) {
      modulus[node] = kappa;
      modulus_by_curvature[node] = kappa * c;
    }
  }
  Vectors y = 0.5 * h * modulus.asDiagonal();
  if (!modulus_by_curvature.isZero(0.0)) {
    y -= projection.solve(normal_functional(surface_, positions)) * modulus_by_curvature.asDiagonal();
  }

  const FaceShape& shape = surface_.shape();
  Vectors result = Vectors::Zero(3, positions.cols());
  for (int f = 0; f < surface_.nodes().n_faces(); ++f) {
    const std::vector<int>& of_face = surface_.nodes().of_face(f);
    const auto [kappa, c] = energy[surface_.nodes().vesicle(f)];
    const FacePatch patch = surface_.patch(f, positions);
    const Vectors local_y = at_nodes(y, of_face);
    const Vectors h_values = at_nodes(h, of_face) * shape.value.transpose();
    const Vectors y_values = local_y * shape.value.transpose();
    const std::array<Vectors, 2> slope{local_y * shape.derivative[0].transpose(),
                                       local_y * shape.derivative[1].transpose()};
    const Vector divergence = surface_divergence(patch, slope);
    std::array<Vectors, 2> stress{Vectors(3, patch.weight.size()), Vectors(3, patch.weight.size())};
    for (Eigen::Index q = 0; q < patch.weight.size(); ++q) {
      const Vector3 n = patch.normal.col(q);
      const double density = 0.25 * kappa * (h_values.col(q) - 2.0 * c * n).squaredNorm() -
                             h_values.col(q).dot(y_values.col(q)) - divergence[q];
      for (int a = 0; a < 2; ++a) {
        const Vector3 up = patch.dual[a].col(q);
        Vector3 derivative = density * up + kappa * c * h_values.col(q).dot(up) * n;
        for (int b = 0; b < 2; ++b) {
          const Vector3 other = patch.dual[b].col(q);
          const Vector3 by = slope[b].col(q);
          derivative += up.dot(by) * other - up.dot(other) * n.dot(by) * n;
        }
        stress[a].col(q) = patch.weight[q] * derivative;
      }
    }
    add_to_nodes(-stress[0] * shape.derivative[0] - stress[1] * shape.derivative[1], of_face, result);
  }
  return result;
}

Vectors restricted(const Vectors& functional, const FaceNodes& from, const FaceNodes& to) {
  const Eigen::MatrixXd value = face_shape(to.degree(), face_node_points(from.degree())).value;
  std::vector<bool> is_done(static_cast<std::size_t>(from.size()), false);
  Vectors result = Vectors::Zero(3, to.size());
  for (int f = 0; f < from.n_faces(); ++f) {
    for (std::size_t i = 0; i < from.of_face(f).size(); ++i) {
      const int node = from.of_face(f)[i];
      if (is_done[static_cast<std::size_t>(node)]) continue;
      is_done[static_cast<std::size_t>(node)] = true;
      for (std::size_t j = 0; j < to.of_face(f).size(); ++j) {
        result.col(to.of_face(f)[j]) +=
            value(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * functional.col(node);
      }
    }
  }
  return result;
}

namespace {

void require_holds(int degree, int field_degree) {
  if (degree >= field_degree) return;
  throw std::invalid_argument("elements of bending of degree " + std::to_string(degree) +
                              " do not include functions of degree " + std::to_string(field_degree));
}

}  // namespace

BendingForce::BendingForce(const Discretisation& discretisation, const PerVesicle<BendingEnergy>& energy, int degree)
    : space_(discretisation.space()),
      elements_(*space_->mesh, degree),
      functional_(elements_.force_functional(energy, elements_.surface().positions())) {}

VectorOnSurface BendingForce::field(int degree) const {
  const SurfaceElements& surface = elements_.surface();
  require_holds(surface.nodes().degree(), degree);
  const auto nodes = std::make_shared<const FaceNodes>(*space_->mesh, degree);
  const Vectors functional = restricted(functional_, surface.nodes(), *nodes);
  const Vectors nodal = SurfaceProjection(surface, surface.positions(), *nodes).solve(functional);
  return [nodes, nodal](const SurfacePoints& points) { return Vectors(values_at(nodal, *nodes, points)); };
}

VectorOnSurface BendingForce::on_trace() const {
  const auto degree = static_cast<int>(space_->element.degree);
  require_holds(elements_.surface().nodes().degree(), degree);
  const FaceNodes trace_nodes(*space_->mesh, degree);
  const Vectors functional = restricted(functional_, elements_.surface().nodes(), trace_nodes);
  const std::shared_ptr<const MembraneTrace> trace = space_->trace;
  Eigen::MatrixX3d in_pairs(trace->size(), 3);
  for (int f = 0; f < trace_nodes.n_faces(); ++f) {
    for (std::size_t i = 0; i < trace_nodes.of_face(f).size(); ++i) {
      in_pairs.row(trace->pairs().of_face[f][i]) = functional.col(trace_nodes.of_face(f)[i]).transpose();
    }
  }
  Eigen::MatrixX3d nodal(trace->size(), 3);
  for (int d = 0; d < 3; ++d) nodal.col(d) = trace->project(in_pairs.col(d));
  return [trace, nodal](const SurfacePoints& points) {
    Vectors result(3, points.size());
    for (int d = 0; d < 3; ++d) result.row(d) = trace->evaluate(nodal.col(d), points).transpose();
    return result;
  };
}

VectorOnSurface bending_force(const Discretisation& discretisation, const BendingEnergy& energy, int degree) {
  return BendingForce(discretisation, energy, degree).on_trace();
}

}  // namespace vehd::fem_check
