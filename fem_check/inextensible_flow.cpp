#include "fem_check/inextensible_flow.hpp"

#include <algorithm>
#include <cmath>

#include "fem_check/krylov.hpp"
#include "fem_check/membrane_trace.hpp"
#include "fem_check/stokes_system.hpp"
#include "fem_check/tension_elements.hpp"

namespace vehd::fem_check {

struct InextensibleFlow::Data {
  FlowSolution flow;
  std::shared_ptr<const MembraneTrace> trace;
  std::shared_ptr<const TensionElements> elements;
  Vector tension;
  Eigen::MatrixX3d force;  // f_λ at the nodes of the trace
  bool constant_is_determined;
};

namespace {

/// Below this variation of H (TensionElements) a constant tension has no noticeable effect on the flow.
constexpr double least_variation = 1e-3;

/// Required relative norm of the residual for a given error of λ. If H varies little, the force of a constant tension
/// is almost a pressure: the energy of the flow that it drives underestimates an error of this tension by the factor of
/// the variation.
double residual_for(double tolerance, const TensionElements& elements, bool constant_is_determined) {
  return constant_is_determined ? tolerance * std::min(1.0, elements.variation_of_curvature()) : tolerance;
}

/// Follows the blocks of the flow. The first rank stores all of it.
constexpr unsigned tension_block = 4;

/// [[Stokes, Cᵀ/R], [C/R, 0]] in the units of the Stokes system: the last block is λ/μ_e, R is the length of the space.
class InextensibleSystem {
 public:
  InextensibleSystem(const StokesSystem& stokes, const TensionElements& elements)
      : stokes_(stokes), elements_(elements) {
    const SheetPairs& pairs = stokes.space().trace->pairs();
    const FaceNodes& nodes = elements.velocity_nodes();
    pair_of_node_.resize(static_cast<std::size_t>(nodes.size()));
    for (int f = 0; f < nodes.n_faces(); ++f) {
      for (std::size_t i = 0; i < nodes.of_face(f).size(); ++i) {
        pair_of_node_[nodes.of_face(f)[i]] = pairs.of_face[f][i];
      }
    }
    // Degrees of freedom of the outside represent both sides.
    const Blocks blocks = stokes.zero();
    const auto& partition = *blocks.block(0).get_partitioner();
    for (std::size_t node = 0; node < pair_of_node_.size(); ++node) {
      const DofIndex dof = pairs.pairs[pair_of_node_[node]][1];
      if (partition.in_local_range(dof))
        own_.push_back({static_cast<Eigen::Index>(node), partition.global_to_local(dof)});
    }
  }

  [[nodiscard]] Blocks zero() const {
    const Blocks flow = stokes_.zero();
    dealii::IndexSet own(static_cast<DofIndex>(elements_.tension_nodes().size()));
    if (dealii::Utilities::MPI::this_mpi_process(communicator()) == 0) own.add_range(0, own.size());
    Blocks result(tension_block + 1);
    for (unsigned b = 0; b < tension_block; ++b) result.block(b).reinit(flow.block(b));
    result.block(tension_block).reinit(own, communicator());
    result.collect_sizes();
    return result;
  }

  void vmult(Blocks& to, const Blocks& from) const {
    stokes_.vmult(to, from);
    const Vector tension = tension_of(from) / stokes_.space().length;
    for (unsigned d = 0; d < 3; ++d) {
      const Vector push = elements_.divergence()[d].transpose() * tension;
      for (const auto& [node, place] : own_) to.block(d).local_element(place) += push[node];
    }
    set_tension(expansion_of(from), to);
  }

  /// C u/R on all ranks.
  [[nodiscard]] Vector expansion_of(const Blocks& from) const {
    Vector expansion = Vector::Zero(elements_.tension_nodes().size());
    for (unsigned d = 0; d < 3; ++d) {
      Vector velocity = Vector::Zero(elements_.velocity_nodes().size());
      for (const auto& [node, place] : own_) velocity[node] = from.block(d).local_element(place);
      expansion += elements_.divergence()[d] * velocity;
    }
    return sum_over_ranks(std::move(expansion)) / stokes_.space().length;
  }

  [[nodiscard]] Vector sum_over_ranks(Vector part) const {
    const dealii::ArrayView<double> values(part.data(), static_cast<std::size_t>(part.size()));
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(values), communicator(), values);
    return part;
  }

  /// The last block on all ranks.
  [[nodiscard]] Vector tension_of(const Blocks& x) const {
    const dealii::Vector<double> values = on_all_ranks(x.block(tension_block), communicator());
    return Eigen::Map<const Vector>(values.begin(), static_cast<Eigen::Index>(values.size()));
  }
  /// Sets the last block to values given on all ranks.
  static void set_tension(const Vector& values, Blocks& to) {
    Distributed& block = to.block(tension_block);
    std::copy_n(values.data(), block.locally_owned_size(), block.begin());
  }

  /// Values at the nodes of the trace, in the order of its pairs, from those at the nodes of the elements.
  [[nodiscard]] Vector in_pairs(const Vector& nodal) const {
    Vector result(nodal.size());
    for (Eigen::Index i = 0; i < nodal.size(); ++i) result[pair_of_node_[i]] = nodal[i];
    return result;
  }

 private:
  /// A node of γ whose velocity is stored on this rank.
  struct OwnNode {
    Eigen::Index node;
    unsigned place;  ///< local index on this rank
  };

  [[nodiscard]] MPI_Comm communicator() const { return stokes_.space().communicator; }

  const StokesSystem& stokes_;
  const TensionElements& elements_;
  std::vector<int> pair_of_node_;
  std::vector<OwnNode> own_;
};

/// Preconditioners of the blocks.
struct BlockPreconditioners {
  const StokesSystem& stokes;
  const InextensibleSystem& system;
  const TensionPreconditioner& tension;

  /// Preconditions the last block. In the units of the blocks, the operator of the tension has the factor μ_e/R.
  [[nodiscard]] Vector apply_tension(const Vector& residual) const {
    const double unit = stokes.space().length * stokes.space().length / stokes.functional_unit();
    return system.sum_over_ranks(unit * tension.apply(residual));
  }
};

/// Preconditions each block separately.
struct DiagonalPreconditioner {
  const BlockPreconditioners& blocks;

  void vmult(Blocks& to, const Blocks& from) const {
    blocks.stokes.precondition(to, from);
    InextensibleSystem::set_tension(blocks.apply_tension(blocks.system.tension_of(from)), to);
  }
};

/// Preconditions velocity, then pressure and tension; see StokesSystem::precondition_triangular().
struct TriangularPreconditioner {
  const BlockPreconditioners& blocks;

  void vmult(Blocks& to, const Blocks& from) const {
    blocks.stokes.precondition_triangular(to, from);
    const Vector left = blocks.system.expansion_of(to) - blocks.system.tension_of(from);
    InextensibleSystem::set_tension(blocks.apply_tension(left), to);
  }
};

}  // namespace

struct InextensibleOperators::Data {
  FlowOperators flow;
  std::shared_ptr<const TensionElements> elements;
  bool constant_is_determined;
  TensionPreconditioner preconditioner;
};

InextensibleOperators::InextensibleOperators(const Discretisation& discretisation, FlowOperators flow) {
  const Space& space = *discretisation.space();
  if (space.n_vesicles > 1) throw std::invalid_argument("the tension can be computed for one vesicle only");
  const int degree = discretisation.degree();
  const auto elements = std::make_shared<const TensionElements>(*space.mesh, degree, degree - 1);
  const bool constant_is_determined = elements->variation_of_curvature() > least_variation;
  const Viscosities& viscosities = flow.data().system.viscosities();
  const InverseRoot::Share share{static_cast<int>(dealii::Utilities::MPI::this_mpi_process(space.communicator)),
                                 static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(space.communicator))};
  TensionPreconditioner preconditioner(*elements, viscosities.inside[0], viscosities.outside, !constant_is_determined,
                                       share);
  data_ =
      std::make_shared<const Data>(Data{std::move(flow), elements, constant_is_determined, std::move(preconditioner)});
}

InextensibleFlow solve_inextensible_flow(const Discretisation& discretisation, const FlowProblem& problem,
                                         const InextensibleFlow* start) {
  const FlowOperators flow(discretisation, problem.viscosity_in, problem.viscosity_out, problem.wall);
  return solve_inextensible_flow(InextensibleOperators(discretisation, flow), problem, start);
}

InextensibleFlow solve_inextensible_flow(const InextensibleOperators& operators, const FlowProblem& problem,
                                         const InextensibleFlow* start) {
  const InextensibleOperators::Data& set_up = operators.data();
  const StokesSystem stokes = system_for(set_up.flow, problem);
  const Space& space = stokes.space();
  const std::shared_ptr<const TensionElements>& elements = set_up.elements;
  const InextensibleSystem system(stokes, *elements);
  const BlockPreconditioners blocks{stokes, system, set_up.preconditioner};
  const DiagonalPreconditioner measure{blocks};
  Cost cost;

  const Blocks load = stokes.load(problem.force, problem.gradient);
  Blocks b = system.zero();
  for (unsigned block = 0; block < tension_block; ++block) b.block(block) = load.block(block);
  // ∇_γ·(½ e x) = e, so the dilation is subtracted from the gradient.
  const Matrix3 left_out = problem.gradient - 0.5 * problem.dilation * Matrix3::Identity();
  InextensibleSystem::set_tension(-elements->divergence_of_linear_flow(left_out) / space.length, b);
  Blocks x = system.zero();
  if (start != nullptr) {
    begin_from(start->flow(), stokes, x);
    InextensibleSystem::set_tension(
        space.length / stokes.functional_unit() *
            interpolated(start->data().tension, start->data().elements->tension_nodes(), elements->tension_nodes()),
        x);
  }
  const double size = energy_of_residual(measure, b);
  if (!std::isfinite(size)) throw SolveError("the right-hand side of the inextensible flow is not finite");
  if (size > 0.0) {
    const double goal = residual_for(problem.tolerance, *elements, set_up.constant_is_determined) * size;
    const double residual = generalised_minimal_residuals(system, measure, TriangularPreconditioner{blocks}, b, x, goal,
                                                          cost.iterations, "inextensible flow");
    cost.solver_error = residual / size;
  } else {
    x = 0.0;
  }

  const Vector tension = stokes.functional_unit() / space.length * system.tension_of(x);
  Eigen::MatrixX3d force(space.trace->size(), 3);
  for (int d = 0; d < 3; ++d) {
    force.col(d) = space.trace->project(system.in_pairs(-(elements->divergence()[d].transpose() * tension)));
  }
  return InextensibleFlow(std::make_shared<const InextensibleFlow::Data>(
      InextensibleFlow::Data{flow_solution(stokes, problem, x, cost), space.trace, elements,
                             set_up.constant_is_determined ? tension : elements->without_mean(tension), force,
                             set_up.constant_is_determined}));
}

const FlowSolution& InextensibleFlow::flow() const { return data_->flow; }

Vector InextensibleFlow::tension(const SurfacePoints& points) const {
  return data_->elements->evaluate(data_->tension, points);
}

Vectors InextensibleFlow::tension_force(const SurfacePoints& points) const {
  Vectors result(3, points.size());
  for (int d = 0; d < 3; ++d) result.row(d) = data_->trace->evaluate(data_->force.col(d), points).transpose();
  return result;
}

bool InextensibleFlow::constant_is_determined() const { return data_->constant_is_determined; }

}  // namespace vehd::fem_check
