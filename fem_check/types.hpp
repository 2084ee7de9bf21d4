#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

/// Finite elements on both sides of a frozen membrane γ. Signs as in docs/conventions.md: n points outwards,
/// [[a]] = a_i − a_e, θ from the +z axis. Weak forms: docs/weak_forms.md.
namespace vehd::fem_check {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector = Eigen::VectorXd;
using Vectors = Eigen::Matrix3Xd;  ///< one column per point

/// Side of the membrane.
enum class Side { inside, outside };

/// A solver that did not reach its tolerance, or a result that is not finite.
class SolveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A point that lies in no cell, for example beyond the outer sphere.
class LocationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Points of γ in the curved mesh; those of one membrane face are contiguous.
struct SurfacePoints {
  Vectors position;
  Vectors normal;                     ///< outward unit normal of the mesh
  Vectors direction;                  ///< r̂(θ, φ) of the parametrisation x(θ, φ)
  Vector weight;                      ///< ∫ f dA = Σ f weight; zero if the points are no quadrature rule
  std::vector<int> face;              ///< number of the membrane face
  std::vector<int> vesicle;           ///< number of the vesicle
  Eigen::Matrix2Xd face_coordinates;  ///< in [0, 1]² of that face

  [[nodiscard]] Eigen::Index size() const { return position.cols(); }
  /// θ of each point, [size()].
  [[nodiscard]] Vector theta() const;
  /// φ of each point, [size()].
  [[nodiscard]] Vector phi() const;
  /// Indices of the points on one membrane.
  [[nodiscard]] std::vector<Eigen::Index> of_vesicle(int number) const;
  /// Selection of the points.
  [[nodiscard]] SurfacePoints picked(const std::vector<Eigen::Index>& numbers) const;
};

/// Points of the volume, each with the cell that contains it.
struct VolumePoints {
  Vectors position;
  std::vector<int> cell;
  std::vector<bool> inside;  ///< in the interior of a vesicle
  Vectors unit;              ///< coordinates in the unit cell

  [[nodiscard]] Eigen::Index size() const { return position.cols(); }
};

/// Fields given on γ: [points.size()] values, or [3 x points.size()].
using ScalarOnSurface = std::function<Vector(const SurfacePoints&)>;
using VectorOnSurface = std::function<Vectors(const SurfacePoints&)>;

/// Largest degree of the spherical harmonics on the outer sphere for which the exterior condition is exact. The error
/// from the next degree is reduced by (a/R)^17 for a flow and (a/R)^19 for a potential at a membrane that reaches out
/// to a, R the radius of the sphere.
constexpr int usual_exterior_degree = 8;

/// Cost of a solution. Peak memory is that of the process on this rank until the end of the solution.
struct Cost {
  long n_unknowns = 0;
  int iterations = 0;
  /// Residual over right-hand side in the norm of the preconditioner: approximately the relative error in the energy
  /// norm that the linear solver leaves.
  double solver_error = 0.0;
  std::size_t peak_memory_bytes = 0;
};

/// ‖a − b‖/‖b‖ in L2(γ) of a vector field, [components x points], or a scalar field, [points] or [1 x points].
double relative_l2(const SurfacePoints& points, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// max |a − b| / max |b| over the points, |·| the Euclidean norm of a vector.
double relative_max(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace vehd::fem_check
