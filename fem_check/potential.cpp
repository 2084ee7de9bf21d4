#include "fem_check/potential.hpp"

#include <cmath>
#include <stdexcept>

#include "fem_check/exterior_field.hpp"
#include "fem_check/krylov.hpp"
#include "fem_check/membrane_condition.hpp"
#include "fem_check/multigrid.hpp"
#include "fem_check/potential_data.hpp"

namespace vehd::fem_check {

using PotentialData = PotentialSolution::Data;

/// Equations of one problem; lengths in units of the space, conductivities relative to that of the outside.
class PotentialEquations {
 public:
  explicit PotentialEquations(PotentialData& data)
      : data_(data),
        space_(*data.space),
        trace_(*space_.trace),
        membrane_(membrane_coefficient(data.problem, space_.n_vesicles)),
        unit_(data.problem.conductivity_out * space_.length),
        multigrid_(space_, fixed_nodes(data.problem, space_.n_vesicles),
                   {over_outside(1.0, data.problem.conductivity_in), 1.0, over_outside(space_.length, membrane_),
                    has_exterior_field() ? dipole_coefficient : 0.0},
                   Multigrid::Finest::solves) {
    if (has_exterior_field()) {
      const Stiffness& finest = multigrid_.finest();
      Eigen::MatrixXd matrix = exterior_potential(data.problem.exterior_degree, dipole_coefficient);
      if (const std::optional<meshes::Wall>& wall = space_.mesh->wall()) {
        const double parity = data.problem.wall == WallField::electrode ? -1.0 : 1.0;
        matrix = continued(matrix, Eigen::MatrixXd::Constant(1, 1, parity), wall->normal);
      }
      exterior_ = std::make_unique<HarmonicTerms>(space_, finest.handler(), finest.constraints(), finest.outer(), 1,
                                                  std::move(matrix));
    }
    take_field();
    multigrid_.finest().initialize(unknowns_);
  }

  /// Takes the field of the problem, which can change between solutions.
  void take_field() {
    current_data_ = -data_.problem.conductivity_out * (trace_.rule().normal.transpose() * data_.problem.field);
    if (data_.problem.current_jump) current_data_ += data_.problem.current_jump(trace_.rule());
  }

  /// Takes the initial guess from another solution on the same mesh.
  void begin_from(const PotentialData& start) {
    data_.constant = start.constant;
    const Stiffness& stiffness = multigrid_.finest();
    interpolate(start.space->dofs, start.nodal, stiffness.handler(), stiffness.constraints(), unknowns_);
    const dealii::Vector<double> lift = lifting();
    for (const DofIndex dof : unknowns_.locally_owned_elements()) {
      if (!stiffness.constraints().is_constrained(dof)) unknowns_(dof) -= lift[dof];
    }
  }

  /// @param memory  added to the current −g V_m of the membrane law, at the points of the rule
  void solve(const Vector& memory) {
    // A constant inside a good conductor has no energy but is large compared with the variation there: it is split off.
    std::vector<int> shifted;
    for (int vesicle = 0; vesicle < space_.n_vesicles; ++vesicle) {
      if (conducts_better(vesicle) && !mean_is_free(data_.problem, vesicle) && data_.constant[vesicle] == 0.0) {
        shifted.push_back(vesicle);
      }
    }
    const double tolerance = data_.problem.tolerance;
    if (!shifted.empty()) solve_for(memory, std::sqrt(tolerance));
    for (const int vesicle : shifted) move_constant(vesicle);
    solve_for(memory, tolerance);
  }

  /// j = σ_i ∂φ_i/∂n, computed from the poorer conductor: on the other side it is a difference of large numbers.
  [[nodiscard]] Vector current() const {
    const Stiffness& stiffness = multigrid_.finest();
    const std::vector<int>& vesicle = trace_.pairs().vesicle;
    Vector of_inside, of_outside;
    for (int k = 0; k < space_.n_vesicles; ++k) {
      if (conducts_better(k) && of_outside.size() == 0) {
        of_outside = trace_.integrate(current_data_) - unit_ * stiffness.flux_functional(data_.nodal, Side::outside);
      }
      if (!conducts_better(k) && of_inside.size() == 0) {
        of_inside = space_.length * stiffness.flux_functional(data_.nodal, Side::inside);
      }
    }
    Vector functional(trace_.size());
    for (Eigen::Index p = 0; p < functional.size(); ++p) {
      const int k = vesicle[static_cast<std::size_t>(p)];
      functional[p] = conducts_better(k) ? of_outside[p] : data_.problem.conductivity_in[k] * of_inside[p];
    }
    return trace_.project(functional);
  }

  /// Operator of the equations: the scalar form, and the exterior field at the outer sphere.
  void vmult(Distributed& to, const Distributed& from) const {
    multigrid_.finest().vmult(to, from);
    if (exterior_) exterior_->add({&to}, {&from});
  }

 private:
  /// −R ∂u/∂r over u of a dipole; the preconditioner uses it for every field on the outer sphere.
  static constexpr double dipole_coefficient = 2.0;

  [[nodiscard]] bool has_exterior_field() const {
    return data_.problem.outer.kind == OuterCondition::Kind::exterior_field;
  }
  /// Whether the inside conducts better than the outside.
  [[nodiscard]] bool conducts_better(int vesicle) const {
    return data_.problem.conductivity_in[vesicle] > data_.problem.conductivity_out;
  }
  /// Coefficients of a form, relative to the conductivity outside.
  [[nodiscard]] PerVesicle<double> over_outside(double factor, const PerVesicle<double>& of) const {
    return per_vesicle(space_.n_vesicles,
                       [&](int vesicle) { return factor * of[vesicle] / data_.problem.conductivity_out; });
  }
  /// Values at the points of the rule times the coefficient g of the membrane.
  [[nodiscard]] Vector times_membrane(Vector values) const {
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] *= membrane_[trace_.rule().vesicle[i]];
    return values;
  }

  /// Nodal values that represent the prescribed jump and the given values on the outer sphere; zero at all other nodes.
  [[nodiscard]] dealii::Vector<double> lifting() const {
    const PotentialProblem& problem = data_.problem;
    dealii::Vector<double> result(space_.dofs.n_dofs());
    if (const auto* prescribed = std::get_if<PrescribedJump>(&problem.membrane)) {
      const Vector jump = prescribed->potential_jump(trace_.nodes()) - data_.background(trace_.nodes());
      for (Eigen::Index p = 0; p < trace_.size(); ++p) {
        const bool inner_follows = !conducts_better(trace_.pairs().vesicle[static_cast<std::size_t>(p)]);
        const auto& pair = trace_.pairs().pairs[p];
        result[pair[inner_follows ? 0 : 1]] = inner_follows ? jump[p] : -jump[p];
      }
    }
    if (problem.outer.kind == OuterCondition::Kind::dirichlet && problem.outer.value) {
      const OuterSphere& outer = multigrid_.finest().outer();
      const Vectors positions = outer.positions();
      for (std::size_t i = 0; i < outer.dofs().size(); ++i) {
        result[outer.dofs()[i]] = problem.outer.value(positions.col(static_cast<Eigen::Index>(i)));
      }
    }
    return result;
  }

  /// ∫_γ (c − σ_e E·n) w_e + ∫_γ (memory − g (E·(x − x_0) + c)) [[w]] + outer terms − a(lifting, w), dimensionless.
  [[nodiscard]] Distributed right_side(const Vector& memory, const dealii::Vector<double>& lift) const {
    const Stiffness& stiffness = multigrid_.finest();
    std::vector<DofIndex> inner;
    std::vector<DofIndex> outer;
    for (const auto& pair : trace_.pairs().pairs) {
      inner.push_back(pair[0]);
      outer.push_back(pair[1]);
    }
    Distributed b;
    stiffness.initialize(b);
    const Vector law = trace_.integrate(memory - times_membrane(data_.background(trace_.rule()))) / unit_;
    stiffness.add_at(b, inner, law);
    stiffness.add_at(b, outer, trace_.integrate(current_data_) / unit_ - law);
    const OuterCondition& condition = data_.problem.outer;
    if (condition.kind == OuterCondition::Kind::neumann && condition.value) {
      const OuterSphere& sphere = stiffness.outer();
      stiffness.add_at(b, sphere.dofs(), space_.length * sphere.integrate(condition.value));
    }
    stiffness.add_cells(b, -1.0, lift);
    return b;
  }

  void solve_for(const Vector& memory, double tolerance) {
    const dealii::Vector<double> lift = lifting();
    const Distributed b = right_side(memory, lift);
    const Stiffness& stiffness = multigrid_.finest();
    const double size = energy_of_residual(multigrid_, b);
    if (!std::isfinite(size)) throw SolveError("the right-hand side of the potential is not finite");
    data_.cost.solver_error = 0.0;
    if (size > 0.0) {
      data_.cost.solver_error =
          minimal_residuals(*this, multigrid_, b, unknowns_, tolerance * size, data_.cost.iterations, "potential") /
          size;
    } else {
      unknowns_ = 0.0;
    }
    data_.nodal = on_all_ranks(unknowns_, space_.communicator);
    stiffness.constraints().distribute(data_.nodal);
    data_.nodal += lift;
  }

  /// Adds the value at one inner node of a vesicle to its constant, and subtracts it from the unknowns inside.
  void move_constant(int vesicle) {
    const double step = data_.nodal[trace_.pairs().first_of(vesicle)[0]];
    data_.constant[vesicle] += step;
    std::vector<DofIndex> dofs(space_.element.n_dofs_per_cell());
    std::vector<bool> moved(space_.dofs.n_dofs(), false);
    for (const auto& cell : space_.dofs.active_cell_iterators()) {
      const auto index = static_cast<unsigned>(cell->index());
      if (!space_.inside(index) || space_.vesicle(index) != vesicle) continue;
      cell->get_dof_indices(dofs);
      for (const DofIndex dof : dofs) {
        if (!moved[dof] && unknowns_.locally_owned_elements().is_element(dof)) unknowns_(dof) -= step;
        moved[dof] = true;
      }
    }
  }

  PotentialData& data_;
  const Space& space_;
  const MembraneTrace& trace_;
  PerVesicle<double> membrane_;  // coefficient of [[u]][[w]]
  double unit_;                  // of functionals: σ_e R
  Multigrid multigrid_;
  std::unique_ptr<HarmonicTerms> exterior_;
  Vector current_data_;  // c − σ_e E·n
  Distributed unknowns_;
};

namespace {

std::shared_ptr<PotentialData> data_of(const Discretisation& discretisation, const PotentialProblem& problem) {
  require_valid(problem);
  auto data = std::make_shared<PotentialData>();
  data->space = discretisation.space();
  data->problem = problem;
  data->constant.assign(static_cast<std::size_t>(data->space->n_vesicles), 0.0);
  data->cost.n_unknowns = discretisation.n_nodes();
  return data;
}

/// Sets the mean of V_m on vesicles where nothing else fixes it.
void set_free_means(PotentialData& data) {
  const SurfacePoints& rule = data.space->trace->rule();
  const Vector voltage = membrane_voltage(data, rule);
  for (int vesicle = 0; vesicle < data.space->n_vesicles; ++vesicle) {
    if (!mean_is_free(data.problem, vesicle)) continue;
    double integral = 0.0, area = 0.0;
    for (Eigen::Index i = 0; i < rule.size(); ++i) {
      if (rule.vesicle[i] != vesicle) continue;
      integral += rule.weight[i] * voltage[i];
      area += rule.weight[i];
    }
    data.constant[vesicle] += std::get<SteadyMembrane>(data.problem.membrane).mean[vesicle] - integral / area;
  }
}

}  // namespace

PotentialSolution solve_potential(const Discretisation& discretisation, const PotentialProblem& problem,
                                  const PotentialSolution* start) {
  const auto data = data_of(discretisation, problem);
  const Space& space = *data->space;
  const MembraneTrace& trace = *space.trace;
  const SurfacePoints& rule = trace.rule();
  Cost& cost = data->cost;

  PotentialEquations equations(*data);
  if (start != nullptr) equations.begin_from(start->data());
  if (const auto* charging = std::get_if<ChargingMembrane>(&problem.membrane)) {
    Vector voltage = charging->initial(rule);
    for (int step = 0; step < charging->steps; ++step) {
      equations.solve(stored_current(*charging, rule, voltage));
      voltage = membrane_voltage(*data, rule);
    }
  } else if (const auto* charged = std::get_if<ChargedMembrane>(&problem.membrane)) {
    equations.solve(charged->inner_charge(rule));
  } else {
    equations.solve(Vector::Zero(rule.size()));
    set_free_means(*data);
  }
  // E_∞·x is not a trace function. If V_m is small by comparison, projecting the sum removes that error from V_m.
  data->voltage = trace.project(trace.integrate(membrane_voltage(*data, rule)));
  data->current = equations.current();

  cost.peak_memory_bytes = peak_memory_bytes();
  return PotentialSolution(data);
}

struct ChargingSteps::Implementation {
  std::shared_ptr<PotentialData> data;
  PotentialEquations equations;
};

ChargingSteps::ChargingSteps(const Discretisation& discretisation, const PotentialProblem& problem) {
  PotentialProblem complete = problem;
  auto& charging = std::get<ChargingMembrane>(complete.membrane);
  charging.initial = [](const SurfacePoints& points) { return Vector(Vector::Zero(points.size())); };
  charging.steps = 1;
  const std::shared_ptr<PotentialData> data = data_of(discretisation, complete);
  implementation_.reset(new Implementation{data, PotentialEquations(*data)});
}

ChargingSteps::~ChargingSteps() = default;
ChargingSteps::ChargingSteps(ChargingSteps&&) noexcept = default;
ChargingSteps& ChargingSteps::operator=(ChargingSteps&&) noexcept = default;

Vector ChargingSteps::step(const Vector& from, const Vector3& field) {
  if (from.size() != rule().size()) throw std::invalid_argument("V_m of a step is not given at the points of the rule");
  PotentialData& data = *implementation_->data;
  const auto& charging = std::get<ChargingMembrane>(data.problem.membrane);
  data.problem.field = field;
  implementation_->equations.take_field();
  implementation_->equations.solve(stored_current(charging, rule(), from));
  data.cost.peak_memory_bytes = peak_memory_bytes();
  return membrane_voltage(data, rule());
}

const SurfacePoints& ChargingSteps::rule() const { return implementation_->data->space->trace->rule(); }

Vector ChargingSteps::at(const SurfacePoints& points, const Vector& values) const {
  const MembraneTrace& trace = *implementation_->data->space->trace;
  return trace.evaluate(trace.project(trace.integrate(values)), points);
}

const Cost& ChargingSteps::cost() const { return implementation_->data->cost; }

}  // namespace vehd::fem_check
