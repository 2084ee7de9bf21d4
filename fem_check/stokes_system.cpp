#include "fem_check/stokes_system.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "fem_check/krylov.hpp"
#include "fem_check/rigid_part.hpp"
#include "fem_check/slip_wall.hpp"
#include "fem_check/stokes_cells.hpp"

namespace vehd::fem_check {

namespace {

/// The velocity is continuous across γ. On a no-slip wall all components vanish, on a stress-free one the normal
/// component.
Fixed fixed_nodes(bool wall) { return {.tie = Tie::inner_follows_outer, .wall = wall}; }
/// −p n + μ ∂u/∂r = −(4μ/R) u for a stresslet; the preconditioner uses it for every flow on the outer sphere.
constexpr double stresslet_coefficient = 4.0;

void require_valid(const Discretisation& discretisation, const Viscosities& viscosities) {
  if (discretisation.degree() < 2) {
    throw std::invalid_argument("the degree of the velocity must be at least 2, not " +
                                std::to_string(discretisation.degree()));
  }
  std::vector<double> all = viscosities.inside.values();
  all.push_back(viscosities.outside);
  for (const double viscosity : all) {
    if (!(viscosity > 0.0)) {
      throw std::invalid_argument("viscosity is " + std::to_string(viscosity) + "; must be positive");
    }
  }
}

void require_valid(const VectorOnSurface& force, const Matrix3& gradient) {
  // Well above the rounding error of a sum of three numbers.
  if (std::abs(gradient.trace()) > 1e-12 * gradient.norm()) {
    throw std::invalid_argument("the background flow has divergence " + std::to_string(gradient.trace()) +
                                "; an incompressible fluid has none");
  }
  if (!force) throw std::invalid_argument("the force of the membrane is missing");
}

/// Condition on the outer sphere for all components. The term ∇u:∇wᵀ outside adds (∇u)ᵀn on it, which is not part of
/// the condition; since div u = 0 it is a surface operator, subtracted here.
SurfaceTerms outer_terms(const Stiffness& diffusion, double contrast_outside) {
  const OuterSphere& sphere = diffusion.outer();
  std::vector<ComponentCoupling> couplings;
  for (unsigned a = 0; a < 3; ++a) {
    for (unsigned b = a + 1; b < 3 && contrast_outside > 0.0; ++b) {
      couplings.push_back({a, b, -contrast_outside * sphere.rotation(a, b)});
    }
  }
  return {diffusion.space(),
          diffusion.handler(),
          diffusion.constraints(),
          sphere.dofs(),
          stresslet_coefficient * sphere.mass(),
          std::move(couplings)};
}

/// ∫ p q/μ with the interface of the Chebyshev preconditioner.
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

}  // namespace

struct StokesSystem::Implementation {
  std::shared_ptr<const Space> space;
  Viscosities viscosity;
  PerVesicle<double> ratio;  // μ_i/μ_e
  WallFlow wall;
  std::shared_ptr<const dealii::DoFHandler<3>> pressure_dofs;
  Multigrid multigrid;
  std::unique_ptr<SlipWall> slip;  // at a stress-free wall
  StokesCells cells;
  SurfaceTerms outer;
  std::vector<unsigned> tied;  // local numbers
  PressureMass pressure_mass;
  PressureInverse pressure_inverse;
  /// Rigid rotations of every inside that is more viscous than the outside: it does not resist them, but μ∇u:∇w does.
  /// And the inverse matrix of their energies.
  std::vector<std::array<Distributed, 3>> rotations;
  Eigen::MatrixXd rotation_inverse;
  /// The constant pressure in one inside, whose part of the Schur complement is that of the more viscous outside.
  struct InnerPressure {
    Distributed values;
    double factor;
  };
  std::vector<InnerPressure> inner_pressures;

  Implementation(std::shared_ptr<const Space> where, const Viscosities& viscosities, WallFlow wall_flow);
  [[nodiscard]] ScalarForm diffusion_form() const { return {ratio, 1.0, 0.0, stresslet_coefficient}; }
  /// Adds the rotations of one vesicle.
  void add_rotations(const StokesSystem& system, int vesicle);
  void find_rotation_energies(const StokesSystem& system);
  void add_inner_pressure(int vesicle);
  void precondition_velocity(Blocks& to, const Blocks& from) const;
  void precondition_pressure(Distributed& to, const Distributed& from) const;
};

StokesSystem::Implementation::Implementation(std::shared_ptr<const Space> where, const Viscosities& viscosities,
                                             WallFlow wall_flow)
    : space(std::move(where)),
      viscosity(viscosities),
      ratio(per_vesicle(space->n_vesicles,
                        [&](int vesicle) { return viscosities.inside[vesicle] / viscosities.outside; })),
      wall(wall_flow),
      pressure_dofs([&] {
        auto handler = std::make_shared<dealii::DoFHandler<3>>(space->triangulation);
        handler->distribute_dofs(dealii::FE_Q<3>(space->element.degree - 1));
        return handler;
      }()),
      multigrid(*space, fixed_nodes(wall == WallFlow::no_slip), diffusion_form(), Multigrid::Finest::preconditions),
      cells(*space, *pressure_dofs, multigrid.finest().constraints(), ratio),
      outer(outer_terms(multigrid.finest(), cells.contrast_outside())),
      pressure_mass(cells, pressure_dofs->n_dofs()) {
  Distributed velocity;
  cells.initialize_velocity(velocity);
  for (const DofIndex dof : velocity.locally_owned_elements()) {
    if (multigrid.finest().constraints().is_constrained(dof)) {
      tied.push_back(velocity.get_partitioner()->global_to_local(dof));
    }
  }
  pressure_inverse.initialize(pressure_mass, pressure_data(cells));
  if (space->mesh->wall() && wall == WallFlow::stress_free) {
    slip = std::make_unique<SlipWall>(*space, multigrid, fixed_nodes(true), diffusion_form());
  }
}

void StokesSystem::Implementation::add_rotations(const StokesSystem& system, int vesicle) {
  const std::vector<Vector3> places = node_places(*space);
  const bool alone = space->n_vesicles == 1 && !space->mesh->wall();
  const RigidPart rigid = alone ? rigid_in_a_sphere(*space, places) : rigid_in_cells(*space, vesicle);
  for (unsigned axis = 0; axis < 3; ++axis) {
    Blocks unit = system.zero();
    for (unsigned d = 0; d < 3; ++d) {
      Distributed& component = unit.block(d);
      for (const DofIndex dof : component.locally_owned_elements()) {
        if (multigrid.finest().constraints().is_constrained(dof)) continue;
        component(dof) = rigid.share[dof] * Vector3::Unit(axis).cross(Vector3(places[dof] - rigid.centre))[d];
      }
    }
    rotations.push_back({unit.block(0), unit.block(1), unit.block(2)});
  }
}

void StokesSystem::Implementation::find_rotation_energies(const StokesSystem& system) {
  const auto n = static_cast<Eigen::Index>(rotations.size());
  Eigen::MatrixXd energies = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    Blocks unit = system.zero(), product = system.zero();
    for (unsigned d = 0; d < 3; ++d) unit.block(d) = rotations[static_cast<std::size_t>(j)][d];
    system.vmult(product, unit);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (unsigned d = 0; d < 3; ++d) energies(i, j) += rotations[static_cast<std::size_t>(i)][d] * product.block(d);
    }
  }
  rotation_inverse = energies.inverse();
}

void StokesSystem::Implementation::add_inner_pressure(int vesicle) {
  InnerPressure& pressure = inner_pressures.emplace_back();
  cells.initialize_pressure(pressure.values);
  std::vector<DofIndex> dofs(pressure_dofs->get_fe().n_dofs_per_cell());
  for (const auto& cell : pressure_dofs->active_cell_iterators()) {
    const auto index = static_cast<unsigned>(cell->index());
    if (!space->inside(index) || space->vesicle(index) != vesicle) continue;
    cell->get_dof_indices(dofs);
    for (const DofIndex dof : dofs) {
      if (pressure.values.locally_owned_elements().is_element(dof)) pressure.values(dof) = 1.0;
    }
  }
  Distributed product;
  cells.initialize_pressure(product);
  cells.apply_pressure_mass(product, pressure.values);
  const double volume = ratio[vesicle] * (product * pressure.values);
  pressure.factor = 1.0 / volume;
}

StokesSystem::StokesSystem(const Discretisation& discretisation, const Viscosities& viscosity, WallFlow wall,
                           int exterior_degree)
    : exterior_degree_(exterior_degree) {
  require_valid(discretisation, viscosity);
  const auto implementation = std::make_shared<Implementation>(discretisation.space(), viscosity, wall);
  implementation_ = implementation;
  exterior_ = exterior_terms(exterior_degree);
  for (int vesicle = 0; vesicle < space().n_vesicles; ++vesicle) {
    if (implementation->ratio[vesicle] > 1.0) implementation->add_rotations(*this, vesicle);
    if (implementation->ratio[vesicle] < 1.0) implementation->add_inner_pressure(vesicle);
  }
  if (!implementation->rotations.empty()) implementation->find_rotation_energies(*this);
}

StokesSystem StokesSystem::with_exterior(int exterior_degree) const {
  if (exterior_degree == exterior_degree_) return *this;
  StokesSystem result(*this);
  result.exterior_degree_ = exterior_degree;
  result.exterior_ = exterior_terms(exterior_degree);
  return result;
}

std::shared_ptr<const HarmonicTerms> StokesSystem::exterior_terms(int exterior_degree) const {
  const std::optional<meshes::Wall>& wall = space().mesh->wall();
  Eigen::MatrixXd matrix;
  if (wall && implementation_->wall == WallFlow::no_slip) {
    matrix = exterior_flow_at_rest_on_wall(exterior_degree, stresslet_coefficient, wall->normal);
  } else {
    matrix = exterior_flow(exterior_degree, stresslet_coefficient);
    if (wall) {
      matrix = continued(matrix, Matrix3::Identity() - 2.0 * wall->normal * wall->normal.transpose(), wall->normal);
    }
  }
  return std::make_shared<const HarmonicTerms>(space(), diffusion().handler(), diffusion().constraints(),
                                               diffusion().outer(), 3, std::move(matrix));
}

StokesSystem system_for(const FlowOperators& operators, const FlowProblem& problem) {
  const StokesSystem& system = operators.data().system;
  const Viscosities& given = system.viscosities();
  if (given.outside != problem.viscosity_out || given.inside.values() != problem.viscosity_in.values()) {
    throw std::invalid_argument("the operators of the flow were made for other viscosities than the problem has");
  }
  if (system.wall() != problem.wall) {
    throw std::invalid_argument("the operators of the flow were made for another wall than the problem has");
  }
  return system.with_exterior(problem.exterior_degree);
}

Blocks StokesSystem::zero() const {
  Blocks result(4);
  for (unsigned d = 0; d < 3; ++d) implementation_->cells.initialize_velocity(result.block(d));
  implementation_->cells.initialize_pressure(result.block(3));
  result.collect_sizes();
  return result;
}

Blocks StokesSystem::load(const VectorOnSurface& force, const Matrix3& gradient) const {
  require_valid(force, gradient);
  const Space& place = space();
  const SurfacePoints& rule = place.trace->rule();
  const Viscosities& viscosity = implementation_->viscosity;
  // If viscosities differ, the background flow itself has a traction jump.
  Vectors traction = force(rule);
  for (Eigen::Index i = 0; i < rule.size(); ++i) {
    const double difference = viscosity.inside[rule.vesicle[i]] - viscosity.outside;
    traction.col(i) -= difference * (gradient + gradient.transpose()) * rule.normal.col(i);
  }
  std::vector<DofIndex> nodes;
  for (const auto& pair : place.trace->pairs().pairs) nodes.push_back(pair[0]);
  Blocks result = zero();
  for (unsigned d = 0; d < 3; ++d) {
    diffusion().add_at(result.block(d), nodes, place.trace->integrate(traction.row(d).transpose()) / functional_unit());
  }
  return result;
}

void StokesSystem::vmult(Blocks& to, const Blocks& from) const {
  // The loops exchange values with other ranks and store them in the ghost entries of the vectors that they read.
  auto& source = const_cast<Blocks&>(from);
  const StokesCells::Parts to_parts{&to.block(0), &to.block(1), &to.block(2), &to.block(3)};
  const StokesCells::Parts from_parts{&source.block(0), &source.block(1), &source.block(2), &source.block(3)};
  implementation_->cells.apply(to_parts, from_parts);
  const std::vector<Distributed*> to_velocity{&to.block(0), &to.block(1), &to.block(2)};
  const std::vector<const Distributed*> velocity{&from.block(0), &from.block(1), &from.block(2)};
  implementation_->outer.add(to_velocity, velocity);
  exterior_->add(to_velocity, velocity);
  for (unsigned d = 0; d < 3; ++d) {
    for (const unsigned dof : implementation_->tied) to.block(d).local_element(dof) = from.block(d).local_element(dof);
  }
  // The preconditioner returns flows along the wall, so a solver that starts from one stays among them.
  if (implementation_->slip) implementation_->slip->project(to);
}

void StokesSystem::Implementation::precondition_velocity(Blocks& to, const Blocks& from) const {
  if (slip) {
    slip->precondition(to, from);
  } else {
    for (unsigned d = 0; d < 3; ++d) multigrid.vmult(to.block(d), from.block(d));
  }
  if (rotations.empty()) return;
  Vector moments = Vector::Zero(static_cast<Eigen::Index>(rotations.size()));
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    for (unsigned d = 0; d < 3; ++d) moments[static_cast<Eigen::Index>(i)] += rotations[i][d] * from.block(d);
  }
  const Vector rates = rotation_inverse * moments;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    for (unsigned d = 0; d < 3; ++d) to.block(d).add(rates[static_cast<Eigen::Index>(i)], rotations[i][d]);
  }
}

void StokesSystem::Implementation::precondition_pressure(Distributed& to, const Distributed& from) const {
  pressure_inverse.vmult(to, from);
  for (const InnerPressure& pressure : inner_pressures) {
    to.add(pressure.factor * (pressure.values * from), pressure.values);
  }
}

void StokesSystem::precondition(Blocks& to, const Blocks& from) const {
  implementation_->precondition_velocity(to, from);
  implementation_->precondition_pressure(to.block(3), from.block(3));
}

void StokesSystem::precondition_triangular(Blocks& to, const Blocks& from) const {
  implementation_->precondition_velocity(to, from);
  Distributed left(from.block(3));
  implementation_->cells.apply_divergence(left, {&to.block(0), &to.block(1), &to.block(2)});
  left -= from.block(3);
  implementation_->precondition_pressure(to.block(3), left);
}

void StokesSystem::solve(const Blocks& right_side, double tolerance, Blocks& solution, Cost& cost) const {
  struct {
    const StokesSystem& system;
    void vmult(Blocks& to, const Blocks& from) const { system.precondition(to, from); }
  } const measure{*this};
  struct {
    const StokesSystem& system;
    void vmult(Blocks& to, const Blocks& from) const { system.precondition_triangular(to, from); }
  } const preconditioner{*this};
  const double size = energy_of_residual(measure, right_side);
  if (!std::isfinite(size)) throw SolveError("the right-hand side of the flow is not finite");
  if (size == 0.0) {
    solution = 0.0;
    return;
  }
  const double left = generalised_minimal_residuals(*this, measure, preconditioner, right_side, solution,
                                                    tolerance * size, cost.iterations, "flow");
  cost.solver_error = left / size;
}

dealii::Vector<double> StokesSystem::velocity(const Blocks& solution, unsigned component) const {
  dealii::Vector<double> result = on_all_ranks(solution.block(component), space().communicator);
  diffusion().constraints().distribute(result);
  return result;
}

dealii::Vector<double> StokesSystem::pressure(const Blocks& solution) const {
  dealii::Vector<double> result = on_all_ranks(solution.block(3), space().communicator);
  result *= pressure_unit();
  return result;
}

const Viscosities& StokesSystem::viscosities() const { return implementation_->viscosity; }
WallFlow StokesSystem::wall() const { return implementation_->wall; }
const std::shared_ptr<const Space>& StokesSystem::shared_space() const { return implementation_->space; }
const std::shared_ptr<const dealii::DoFHandler<3>>& StokesSystem::pressure_dofs() const {
  return implementation_->pressure_dofs;
}
const Stiffness& StokesSystem::diffusion() const { return implementation_->multigrid.finest(); }
double StokesSystem::functional_unit() const { return implementation_->viscosity.outside * space().length; }
double StokesSystem::pressure_unit() const { return implementation_->viscosity.outside / space().length; }

}  // namespace vehd::fem_check
