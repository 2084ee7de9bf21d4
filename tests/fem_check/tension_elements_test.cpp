#include "fem_check/tension_elements.hpp"

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

BOOST_AUTO_TEST_SUITE(tension_elements)

namespace {

meshes::HexMesh sphere_mesh(int cells_per_edge) { return membrane_mesh(unit_sphere(), cells_per_edge); }

/// inf over λ, sup over v of ∫ λ ∇_γ·v dA/(‖λ‖ ‖v‖_1), v with all three components.
double inf_sup(const meshes::VolumeMesh& mesh, int velocity_degree, int tension_degree) {
  const TensionElements pair(mesh, velocity_degree, tension_degree);
  const TensionElements velocity(mesh, velocity_degree, velocity_degree);
  const Eigen::SparseMatrix<double> norm = velocity.stiffness() + velocity.mass();
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver(norm);
  Eigen::MatrixXd schur = Eigen::MatrixXd::Zero(pair.mass().rows(), pair.mass().cols());
  for (const auto& divergence : pair.divergence()) {
    schur += divergence * Eigen::MatrixXd(solver.solve(Eigen::MatrixXd(divergence.transpose())));
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(schur, Eigen::MatrixXd(pair.mass()),
                                                                        Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues().minCoeff()));
}

}  // namespace

BOOST_AUTO_TEST_CASE(nodes_of_a_closed_surface_are_shared_between_its_faces) {
  // Euler: F quadrilateral faces have F + 2 vertices and 2F edges.
  const meshes::HexMesh mesh = sphere_mesh(2);
  const auto n_faces = static_cast<Eigen::Index>(mesh.interface().size());
  for (const int degree : {1, 2, 5}) BOOST_TEST(FaceNodes(mesh, degree).size() == n_faces * degree * degree + 2);
}

BOOST_AUTO_TEST_CASE(geometry_is_that_of_the_mesh_and_normals_point_outwards) {
  const auto mesh = std::make_shared<const meshes::HexMesh>(membrane_mesh(shapes::shape_33(), 2));
  const SurfacePoints points = Discretisation(mesh, 3).quadrature_points(5);
  const SurfaceElements surface(*mesh, 4, 5);
  Eigen::Index begin = 0;
  for (int f = 0; f < surface.nodes().n_faces(); ++f) {
    const FacePatch patch = surface.patch(f, surface.positions());
    const Eigen::Index n = patch.weight.size();
    BOOST_TEST((patch.weight - points.weight.segment(begin, n)).cwiseAbs().maxCoeff() < 1e-12);
    BOOST_TEST((patch.normal - points.normal.middleCols(begin, n)).cwiseAbs().maxCoeff() < 1e-11);
    begin += n;
  }
}

BOOST_AUTO_TEST_CASE(velocity_of_one_degree_more_than_the_tension_is_stable) {
  for (const int degree : {2, 3, 4}) {
    std::vector<double> constants;
    for (const int n : {1, 2, 3}) constants.push_back(inf_sup(sphere_mesh(n), degree, degree - 1));
    BOOST_TEST_MESSAGE("degree " << degree << ": " << constants[0] << " " << constants[1] << " " << constants[2]);
    BOOST_TEST(constants[2] > 0.2);
    BOOST_TEST(constants[2] > 0.8 * constants[1]);
  }
}

BOOST_AUTO_TEST_CASE(equal_degrees_are_not_stable) {
  BOOST_TEST(inf_sup(sphere_mesh(3), 3, 3) < 0.5 * inf_sup(sphere_mesh(3), 3, 2));
}

BOOST_AUTO_TEST_CASE(work_of_a_tension_is_the_change_of_area_that_it_weighs) {
  // Under the displacement x every area element changes at the relative rate ∇_γ·x = 2.
  const meshes::HexMesh mesh = sphere_mesh(2);
  const TensionElements elements(mesh, 4, 3);
  const SurfaceElements surface(mesh, 4, 6);
  Vector expansion = Vector::Zero(elements.mass().rows());
  for (int d = 0; d < 3; ++d) expansion += elements.divergence()[d] * surface.positions().row(d).transpose();
  const Vector doubled = 2.0 * elements.mass() * Vector::Ones(elements.mass().cols());
  BOOST_TEST((expansion - doubled).norm() < 1e-3 * doubled.norm());
  BOOST_TEST((elements.divergence_of_linear_flow(Matrix3::Identity()) - doubled).norm() < 1e-12 * doubled.norm());
  // Rotations do not change area.
  Matrix3 spin = Matrix3::Zero();
  spin(0, 1) = 1.0;
  spin(1, 0) = -1.0;
  BOOST_TEST(elements.divergence_of_linear_flow(spin).norm() < 1e-12 * doubled.norm());
}

BOOST_AUTO_TEST_CASE(curvature_varies_on_a_prolate_and_not_on_a_sphere) {
  BOOST_TEST(TensionElements(sphere_mesh(1), 2, 1).variation_of_curvature() < 1e-3);
  BOOST_TEST(TensionElements(membrane_mesh(shapes::prolate(), 1), 2, 1).variation_of_curvature() > 0.1);
}

BOOST_AUTO_TEST_CASE(inverse_root_is_that_of_the_eigenvalues) {
  const TensionElements elements(sphere_mesh(2), 3, 2);
  const Eigen::SparseMatrix<double> stiffness = elements.stiffness() + elements.mass();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(stiffness),
                                                                        Eigen::MatrixXd(elements.mass()));
  BOOST_TEST(eigen.eigenvalues().maxCoeff() < elements.largest_eigenvalue() + 1.0);
  const double largest = elements.largest_eigenvalue() + 1.0;
  const InverseRoot root(stiffness, elements.mass(), 1.0, largest, {});
  const InverseRoot first(stiffness, elements.mass(), 1.0, largest, {0, 2}),
      second(stiffness, elements.mass(), 1.0, largest, {1, 2});
  for (const Eigen::Index i : {Eigen::Index(0), Eigen::Index(7), eigen.eigenvalues().size() - 1}) {
    const Vector mode = eigen.eigenvectors().col(i);
    const Vector exact = mode / std::sqrt(eigen.eigenvalues()[i]);
    const Vector applied = root.apply(elements.mass() * mode);
    BOOST_TEST((applied - exact).norm() < 0.05 * exact.norm());
    const Vector in_shares = first.apply(elements.mass() * mode) + second.apply(elements.mass() * mode);
    BOOST_TEST((in_shares - applied).norm() < 1e-12 * applied.norm());
  }
}

BOOST_AUTO_TEST_SUITE_END()
