#include "bie/sphere/principal_axes.hpp"

#include <Eigen/Eigenvalues>

namespace vehd {

PrincipalAxes principal_axes(const Matrix3& tensor) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(tensor);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace vehd
