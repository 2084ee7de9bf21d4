#include "fem_check/stokes_system.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "fem_check/krylov.hpp"
#include "fem_check/stokes_cells.hpp"

namespace vehd::fem_check {

namespace {

/// The velocities of both sides are one.
constexpr Fixed kSheetsTied{.tie = Tie::inner_follows_outer};
/// −p n + μ ∂u/∂r = −(4μ/R) u of a stresslet.
constexpr double kOuterCoefficient = 4.0;

void require_valid(const Discretisation& discretisation, const Viscosities& viscosities) {
  if (discretisation.degree() < 2) {
    throw std::invalid_argument("the flow takes elements of degree 2 at least, the discretisation has degree " +
                                std::to_string(discretisation.degree()));
  }
  for (const double viscosity : {viscosities.inside, viscosities.outside}) {
    if (!(viscosity > 0.0)) {
      throw std::invalid_argument("viscosity is " + std::to_string(viscosity) + "; must be positive");
    }
  }
}

void require_valid(const VectorOnSurface& force, const Matrix3& gradient) {
  // Far above the rounding of a sum of three numbers.
  if (std::abs(gradient.trace()) > 1e-12 * gradient.norm()) {
    throw std::invalid_argument("the background flow has divergence " + std::to_string(gradient.trace()) +
                                "; an incompressible fluid has none");
  }
  if (!force) throw std::invalid_argument("the force of the membrane is missing");
}

/// −p n + μ ∂u/∂r + (4μ/R) u of the Stokeslet and the rotlet that carry the force and the torque: zero for every
/// stresslet.
Vector3 outer_data(const Vector3& r, const Vector3& force, const Vector3& torque, double viscosity) {
  const double radius = r.norm();
  const Vector3 n = r / radius;
  const double scale = 1.0 / (8.0 * std::numbers::pi * viscosity * radius);
  const Vector3 stokeslet = scale * (force + n.dot(force) * n);
  const Vector3 rotlet = scale / radius * torque.cross(n);
  const double pressure = force.dot(n) / (4.0 * std::numbers::pi * radius * radius);
  return 3.0 * viscosity / radius * stokeslet + 2.0 * viscosity / radius * rotlet - pressure * n;
}

/// The condition on the outer sphere for all components. ∇u:∇wᵀ outside brings (∇u)ᵀn there, which is not part of the
/// condition; with div u = 0 it is a surface operator, taken off here.
SurfaceTerms outer_terms(const Stiffness& diffusion, double contrast_outside) {
  const OuterSphere& sphere = diffusion.outer();
  const Eigen::Index n = sphere.size();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const Eigen::SparseMatrix<double>& matrix, double scale, unsigned row, unsigned column) {
    for (Eigen::Index j = 0; j < matrix.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, j); entry; ++entry) {
        entries.emplace_back(row * n + entry.row(), column * n + entry.col(), scale * entry.value());
      }
    }
  };
  for (unsigned a = 0; a < 3; ++a) {
    add(sphere.mass(), kOuterCoefficient, a, a);
    for (unsigned b = a + 1; b < 3 && contrast_outside > 0.0; ++b) {
      const Eigen::SparseMatrix<double> rotation = sphere.rotation(a, b);
      add(rotation, -contrast_outside, a, b);
      add(Eigen::SparseMatrix<double>(rotation.transpose()), -contrast_outside, b, a);
    }
  }
  Eigen::SparseMatrix<double> matrix(3 * n, 3 * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return {diffusion.space(), diffusion.handler(), diffusion.constraints(), sphere.dofs(), std::move(matrix)};
}

/// ∫ p q/μ as Chebyshev's polynomials want it.
class PressureMass : public dealii::Subscriptor {
 public:
  PressureMass(const StokesCells& cells, DofIndex size) : cells_(cells), size_(size) {}
  void vmult(Distributed& to, const Distributed& from) const { cells_.apply_pressure_mass(to, from); }
  [[nodiscard]] DofIndex m() const { return size_; }
  [[nodiscard]] static double el(DofIndex /*row*/, DofIndex /*column*/) {
    throw std::logic_error("no matrix is stored");
  }

 private:
  const StokesCells& cells_;
  DofIndex size_;
};

using PressureInverse = dealii::PreconditionChebyshev<PressureMass, Distributed, dealii::DiagonalMatrix<Distributed>>;

PressureInverse::AdditionalData pressure_data(const StokesCells& cells) {
  PressureInverse::AdditionalData data;
  data.degree = 8;
  data.smoothing_range = 0.0;  // the whole spectrum
  data.eig_cg_n_iterations = 30;
  data.preconditioner = std::make_shared<dealii::DiagonalMatrix<Distributed>>();
  data.preconditioner->get_vector() = cells.inverse_pressure_diagonal();
  return data;
}

/// Places of all nodes of this rank's cells, without unit; zero for others.
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

}  // namespace

struct StokesSystem::Implementation {
  std::shared_ptr<const Space> space;
  Viscosities viscosity;
  double ratio;  // μ_i/μ_e
  std::shared_ptr<const dealii::DoFHandler<3>> pressure_dofs;
  Multigrid multigrid;
  StokesCells cells;
  SurfaceTerms outer;
  std::vector<unsigned> tied;  // local numbers
  PressureMass pressure_mass;
  PressureInverse pressure_inverse;
  /// Rigid rotations of the inside, which a stiff inside does not resist but μ∇u:∇w does; and the inverse of their
  /// energies. Empty where the inside is not the stiffer one.
  std::vector<std::array<Distributed, 3>> rotations;
  Matrix3 rotation_inverse = Matrix3::Zero();
  /// The pressure of one inside, whose share in the Schur complement is that of the stiffer outside.
  Distributed inner_pressure;
  double inner_pressure_factor = 0.0;

  Implementation(std::shared_ptr<const Space> where, const Viscosities& viscosities);
  void find_rotations(const StokesSystem& system);
  void find_inner_pressure();
};

StokesSystem::Implementation::Implementation(std::shared_ptr<const Space> where, const Viscosities& viscosities)
    : space(std::move(where)),
      viscosity(viscosities),
      ratio(viscosities.inside / viscosities.outside),
      pressure_dofs([&] {
        auto handler = std::make_shared<dealii::DoFHandler<3>>(space->triangulation);
        handler->distribute_dofs(dealii::FE_Q<3>(space->element.degree - 1));
        return handler;
      }()),
      multigrid(*space, kSheetsTied, {ratio, 1.0, 0.0, kOuterCoefficient}),
      cells(*space, *pressure_dofs, multigrid.finest().constraints(), ratio, 1.0),
      outer(outer_terms(multigrid.finest(), std::max(0.0, 1.0 - ratio))),
      pressure_mass(cells, pressure_dofs->n_dofs()) {
  Distributed velocity;
  cells.initialize_velocity(velocity);
  for (const DofIndex dof : velocity.locally_owned_elements()) {
    if (multigrid.finest().constraints().is_constrained(dof)) {
      tied.push_back(velocity.get_partitioner()->global_to_local(dof));
    }
  }
  pressure_inverse.initialize(pressure_mass, pressure_data(cells));
}

void StokesSystem::Implementation::find_rotations(const StokesSystem& system) {
  // Rigid up to the sphere around the membrane, then with the decay of a rotlet.
  double reach = 0.0;
  const Vectors& nodes = space->trace->nodes().position;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    reach = std::max(reach, space->dimensionless(nodes.col(i)).norm());
  }
  const std::vector<Vector3> places = node_places(*space);
  std::vector<Blocks> products;
  for (unsigned axis = 0; axis < 3; ++axis) {
    auto& rotation = rotations.emplace_back();
    Blocks unit = system.zero();
    for (unsigned d = 0; d < 3; ++d) {
      Distributed& component = unit.block(d);
      for (const DofIndex dof : component.locally_owned_elements()) {
        if (multigrid.finest().constraints().is_constrained(dof)) continue;
        const Vector3& x = places[dof];
        const double decay = std::pow(std::min(1.0, reach / x.norm()), 3);
        component(dof) = decay * Vector3::Unit(axis).cross(x)[d];
      }
      rotation[d] = component;
    }
    system.vmult(products.emplace_back(system.zero()), unit);
  }
  Matrix3 energies;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) {
      energies(i, j) = 0.0;
      for (unsigned d = 0; d < 3; ++d) energies(i, j) += rotations[i][d] * products[j].block(d);
    }
  }
  rotation_inverse = energies.inverse();
}

void StokesSystem::Implementation::find_inner_pressure() {
  cells.initialize_pressure(inner_pressure);
  std::vector<DofIndex> dofs(pressure_dofs->get_fe().n_dofs_per_cell());
  for (const auto& cell : pressure_dofs->active_cell_iterators()) {
    if (!space->inside(static_cast<unsigned>(cell->index()))) continue;
    cell->get_dof_indices(dofs);
    for (const DofIndex dof : dofs) {
      if (inner_pressure.locally_owned_elements().is_element(dof)) inner_pressure(dof) = 1.0;
    }
  }
  Distributed product;
  cells.initialize_pressure(product);
  cells.apply_pressure_mass(product, inner_pressure);
  const double volume = ratio * (product * inner_pressure);
  inner_pressure_factor = 1.0 / volume;
}

StokesSystem::StokesSystem(const Discretisation& discretisation, const Viscosities& viscosity) {
  require_valid(discretisation, viscosity);
  implementation_ = std::make_unique<Implementation>(discretisation.space(), viscosity);
  if (implementation_->ratio > 1.0) implementation_->find_rotations(*this);
  if (implementation_->ratio < 1.0) implementation_->find_inner_pressure();
}

StokesSystem::~StokesSystem() = default;

Blocks StokesSystem::zero() const {
  Blocks result(4);
  for (unsigned d = 0; d < 3; ++d) implementation_->cells.initialize_velocity(result.block(d));
  implementation_->cells.initialize_pressure(result.block(3));
  result.collect_sizes();
  return result;
}

FlowLoad StokesSystem::load(const VectorOnSurface& force, const Matrix3& gradient) const {
  require_valid(force, gradient);
  const Space& place = space();
  const SurfacePoints& rule = place.trace->rule();
  const Viscosities& viscosity = implementation_->viscosity;
  const Vectors density = force(rule);
  FlowLoad result;
  for (Eigen::Index i = 0; i < rule.size(); ++i) {
    result.net_force += rule.weight[i] * density.col(i);
    result.net_torque += rule.weight[i] * (rule.position.col(i) - place.centre).cross(Vector3(density.col(i)));
  }
  // The background flow has a traction jump of its own where viscosities differ.
  const Matrix3 background = (viscosity.inside - viscosity.outside) * (gradient + gradient.transpose());
  const Vectors traction = density - background * rule.normal;
  std::vector<DofIndex> nodes;
  for (const auto& pair : place.trace->pairs().pairs) nodes.push_back(pair[0]);
  const OuterSphere& sphere = diffusion().outer();
  const double area = place.length * place.length;
  result.functional = zero();
  for (unsigned d = 0; d < 3; ++d) {
    diffusion().add_at(result.functional.block(d), nodes,
                       place.trace->integrate(traction.row(d).transpose()) / functional_unit());
    const Vector outer = sphere.integrate([&](const Vector3& x) {
      return outer_data(x - place.centre, result.net_force, result.net_torque, viscosity.outside)[d];
    });
    diffusion().add_at(result.functional.block(d), sphere.dofs(), area / functional_unit() * outer);
  }
  return result;
}

void StokesSystem::vmult(Blocks& to, const Blocks& from) const {
  // The loops exchange values with other ranks, for which they keep space in the vectors that they read.
  auto& source = const_cast<Blocks&>(from);
  const StokesCells::Parts to_parts{&to.block(0), &to.block(1), &to.block(2), &to.block(3)};
  const StokesCells::Parts from_parts{&source.block(0), &source.block(1), &source.block(2), &source.block(3)};
  implementation_->cells.apply(to_parts, from_parts);
  implementation_->outer.add({&to.block(0), &to.block(1), &to.block(2)},
                             {&from.block(0), &from.block(1), &from.block(2)});
  for (unsigned d = 0; d < 3; ++d) {
    for (const unsigned dof : implementation_->tied) to.block(d).local_element(dof) = from.block(d).local_element(dof);
  }
}

void StokesSystem::precondition(Blocks& to, const Blocks& from) const {
  const Implementation& system = *implementation_;
  for (unsigned d = 0; d < 3; ++d) system.multigrid.vmult(to.block(d), from.block(d));
  if (!system.rotations.empty()) {
    Vector3 moments = Vector3::Zero();
    for (unsigned i = 0; i < 3; ++i) {
      for (unsigned d = 0; d < 3; ++d) moments[i] += system.rotations[i][d] * from.block(d);
    }
    const Vector3 rates = system.rotation_inverse * moments;
    for (unsigned i = 0; i < 3; ++i) {
      for (unsigned d = 0; d < 3; ++d) to.block(d).add(rates[i], system.rotations[i][d]);
    }
  }
  system.pressure_inverse.vmult(to.block(3), from.block(3));
  if (system.inner_pressure_factor > 0.0) {
    to.block(3).add(system.inner_pressure_factor * (system.inner_pressure * from.block(3)), system.inner_pressure);
  }
}

void StokesSystem::solve(const Blocks& right_side, double tolerance, Blocks& solution, Cost& cost) const {
  const auto preconditioner = [this] {
    struct {
      const StokesSystem& system;
      void vmult(Blocks& to, const Blocks& from) const { system.precondition(to, from); }
    } result{*this};
    return result;
  }();
  const double size = energy_of_residual(preconditioner, right_side);
  if (!std::isfinite(size)) throw SolveError("the right-hand side of the flow is not finite");
  if (size == 0.0) {
    solution = 0.0;
    return;
  }
  const double left =
      minimal_residuals(*this, preconditioner, right_side, solution, tolerance * size, cost.iterations, "flow");
  cost.solver_error = left / size;
}

dealii::Vector<double> StokesSystem::velocity(const Blocks& solution, unsigned component) const {
  dealii::Vector<double> result = on_all_ranks(solution.block(component), space().communicator);
  diffusion().constraints().distribute(result);
  return result;
}

dealii::Vector<double> StokesSystem::pressure(const Blocks& solution) const {
  dealii::Vector<double> result = on_all_ranks(solution.block(3), space().communicator);
  result *= implementation_->viscosity.outside / space().length;
  return result;
}

const std::shared_ptr<const Space>& StokesSystem::shared_space() const { return implementation_->space; }
const std::shared_ptr<const dealii::DoFHandler<3>>& StokesSystem::pressure_dofs() const {
  return implementation_->pressure_dofs;
}
const Stiffness& StokesSystem::diffusion() const { return implementation_->multigrid.finest(); }
double StokesSystem::functional_unit() const { return implementation_->viscosity.outside * space().length; }

}  // namespace vehd::fem_check
