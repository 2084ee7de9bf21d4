#include "fem_check/tension_elements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem_check/bending.hpp"

namespace vehd::fem_check {

namespace {

double curvature_variation(const meshes::VolumeMesh& mesh) {
  // High enough that the error on a sphere is far below the smallest significant variation.
  constexpr int degree = 8;
  const BendingElements elements(mesh, degree);
  const SurfaceElements& surface = elements.surface();
  const Vectors h = elements.curvature_vector(surface.positions());
  double area = 0.0, sum = 0.0, squares = 0.0;
  for (int f = 0; f < surface.nodes().n_faces(); ++f) {
    const FacePatch patch = surface.patch(f, surface.positions());
    const Vectors values = at_nodes(h, surface.nodes().of_face(f)) * surface.shape().value.transpose();
    const Vector curvature = 0.5 * values.cwiseProduct(patch.normal).colwise().sum().transpose();
    area += patch.weight.sum();
    sum += patch.weight.dot(curvature);
    squares += patch.weight.dot(curvature.cwiseAbs2());
  }
  return std::sqrt(std::max(0.0, 1.0 - sum * sum / (area * squares)));
}

}  // namespace

TensionElements::TensionElements(const meshes::VolumeMesh& mesh, int velocity_degree, int tension_degree)
    : surface_(mesh, velocity_degree + 1, velocity_degree + 2),
      velocity_nodes_(mesh, velocity_degree),
      tension_nodes_(mesh, tension_degree),
      mass_(mass_matrix(surface_, surface_.positions(), tension_nodes_)),
      stiffness_(stiffness_matrix(surface_, surface_.positions(), tension_nodes_)),
      radius_(std::sqrt(mass_.sum() / (4.0 * std::numbers::pi))),
      largest_eigenvalue_(fem_check::largest_eigenvalue(surface_, surface_.positions(), tension_nodes_)),
      variation_of_curvature_(curvature_variation(mesh)) {
  const FaceShape velocity = face_shape(velocity_degree, surface_.rule());
  const FaceShape tension = face_shape(tension_degree, surface_.rule());
  std::array<SurfaceAssembly, 3> assembly{SurfaceAssembly(tension_nodes_, velocity_nodes_),
                                          SurfaceAssembly(tension_nodes_, velocity_nodes_),
                                          SurfaceAssembly(tension_nodes_, velocity_nodes_)};
  for (int f = 0; f < tension_nodes_.n_faces(); ++f) {
    const FacePatch patch = surface_.patch(f, surface_.positions());
    for (int d = 0; d < 3; ++d) {
      assembly[d].add(f,
                      tension.value.transpose() * patch.weight.asDiagonal() * surface_derivative(patch, velocity, d));
    }
  }
  for (int d = 0; d < 3; ++d) divergence_[d] = assembly[d].matrix();
}

Vector TensionElements::divergence_of_linear_flow(const Matrix3& gradient) const {
  const FaceShape tension = face_shape(tension_nodes_.degree(), surface_.rule());
  Vector result = Vector::Zero(tension_nodes_.size());
  for (int f = 0; f < tension_nodes_.n_faces(); ++f) {
    const FacePatch patch = surface_.patch(f, surface_.positions());
    // ∇_γ·(A x) = tr A − n·A n
    const Vector values = Vector::Constant(patch.weight.size(), gradient.trace()) -
                          (gradient * patch.normal).cwiseProduct(patch.normal).colwise().sum().transpose();
    const Vector local = tension.value.transpose() * patch.weight.cwiseProduct(values);
    for (Eigen::Index i = 0; i < local.size(); ++i) result[tension_nodes_.of_face(f)[i]] += local[i];
  }
  return result;
}

Vector TensionElements::without_mean(const Vector& tension) const {
  const Vector one = Vector::Ones(tension.size());
  const Vector mass_of_one = mass_ * one;
  return tension - one * (mass_of_one.dot(tension) / mass_of_one.sum());
}

Vector TensionElements::evaluate(const Vector& tension, const SurfacePoints& points) const {
  return values_at(tension.transpose(), tension_nodes_, points).transpose();
}

TensionPreconditioner::TensionPreconditioner(const TensionElements& elements, double viscosity_in, double viscosity_out,
                                             bool constant_is_free, InverseRoot::Share share)
    : scale_(2.0 * (viscosity_in + viscosity_out)),
      constant_is_free_(constant_is_free),
      mass_of_one_(elements.mass() * Vector::Ones(elements.mass().cols())),
      root_(elements.stiffness() + elements.mass() / (elements.radius() * elements.radius()), elements.mass(),
            1.0 / (elements.radius() * elements.radius()),
            elements.largest_eigenvalue() + 1.0 / (elements.radius() * elements.radius()), share) {
  const double variation = elements.variation_of_curvature();
  // The root maps the mass of a constant to the constant times R.
  if (!constant_is_free && share.number == 0) {
    of_constant_ = scale_ * elements.radius() / mass_of_one_.sum() * (1.0 / (variation * variation) - 1.0);
  }
}

Vector TensionPreconditioner::apply(const Vector& residual) const {
  if (!constant_is_free_) {
    return scale_ * root_.apply(residual) + Vector::Constant(residual.size(), of_constant_ * residual.sum());
  }
  // Projected on both sides to keep it symmetric: the mean of every tension in the iteration is zero.
  const double area = mass_of_one_.sum();
  const Vector result = scale_ * root_.apply(residual - mass_of_one_ * (residual.sum() / area));
  return result - Vector::Constant(result.size(), mass_of_one_.dot(result) / area);
}

}  // namespace vehd::fem_check
