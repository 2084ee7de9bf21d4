#include "fem_check/inextensible_flow.hpp"

#include "fem_check/minimal_residuals.hpp"
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

/// Below this variation of H, see TensionElements, a constant tension does nothing that would be seen in the flow.
constexpr double least_variation = 1e-3;

/// Blocks of a flow and, last, the tension, all of which the first rank holds.
constexpr unsigned tension_block = 4;

Blocks with_tension(const Blocks& flow, Eigen::Index n_tension, MPI_Comm communicator) {
  dealii::IndexSet tension(static_cast<DofIndex>(n_tension));
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0) tension.add_range(0, tension.size());
  std::vector<dealii::IndexSet> owned;
  for (unsigned b = 0; b < flow.n_blocks(); ++b) owned.push_back(flow.block(b).locally_owned_elements());
  owned.push_back(tension);
  return Blocks(owned, communicator);
}

Vector on_all_ranks(const Distributed& vector) {
  const dealii::Vector<double> copy(vector);
  return Eigen::Map<const Vector>(copy.begin(), static_cast<Eigen::Index>(copy.size()));
}

/// [[Stokes, Cᵀ], [C, 0]].
class InextensibleSystem {
 public:
  InextensibleSystem(const StokesSystem& stokes, const TensionElements& elements)
      : stokes_(stokes), elements_(elements), communicator_(stokes.space().communicator) {
    const SheetPairs& pairs = stokes.space().trace->pairs();
    const FaceNodes& nodes = elements.velocity_nodes();
    const dealii::IndexSet owned = stokes.space().dofs.locally_owned_dofs();
    pair_of_node_.resize(static_cast<std::size_t>(nodes.size()));
    for (int f = 0; f < nodes.n_faces(); ++f) {
      for (std::size_t i = 0; i < nodes.of_face(f).size(); ++i)
        pair_of_node_[nodes.of_face(f)[i]] = pairs.of_face[f][i];
    }
    // The outer sheet stands for both.
    for (std::size_t node = 0; node < pair_of_node_.size(); ++node) {
      const DofIndex dof = pairs.pairs[pair_of_node_[node]][1];
      if (!owned.is_element(dof)) continue;
      owned_nodes_.push_back(static_cast<Eigen::Index>(node));
      owned_places_.push_back(static_cast<std::ptrdiff_t>(owned.index_within_set(dof)));
    }
  }

  [[nodiscard]] Blocks zero() const {
    return with_tension(stokes_.matrix().zero(), elements_.tension_nodes().size(), communicator_);
  }

  void vmult(Blocks& result, const Blocks& x) const {
    stokes_.matrix().vmult(result, x);
    const Vector tension = on_all_ranks(x.block(tension_block));
    Vector expansion = Vector::Zero(tension.size());
    for (unsigned d = 0; d < 3; ++d) {
      const Vector push = elements_.divergence()[d].transpose() * tension;
      Vector velocity = Vector::Zero(push.size());
      const double* from = x.block(d).begin();
      double* to = result.block(d).begin();
      for (std::size_t i = 0; i < owned_nodes_.size(); ++i) {
        to[owned_places_[i]] += push[owned_nodes_[i]];
        velocity[owned_nodes_[i]] = from[owned_places_[i]];
      }
      expansion += elements_.divergence()[d] * velocity;
    }
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(expansion.data(), expansion.size()), communicator_,
                                dealii::ArrayView<double>(expansion.data(), expansion.size()));
    set_tension(expansion, result);
  }

  /// Puts values known on all ranks into the last block.
  static void set_tension(const Vector& values, Blocks& result) {
    Distributed& block = result.block(tension_block);
    std::copy_n(values.data(), block.locally_owned_size(), block.begin());
  }

  /// Values at the nodes of the trace, in its order, from those at the nodes of the elements.
  [[nodiscard]] Vector in_pairs(const Vector& nodal) const {
    Vector result(nodal.size());
    for (Eigen::Index i = 0; i < nodal.size(); ++i) result[pair_of_node_[i]] = nodal[i];
    return result;
  }

 private:
  const StokesSystem& stokes_;
  const TensionElements& elements_;
  MPI_Comm communicator_;
  std::vector<int> pair_of_node_;
  std::vector<Eigen::Index> owned_nodes_;
  std::vector<std::ptrdiff_t> owned_places_;
};

struct InextensiblePreconditioner {
  const StokesSystem& stokes;
  const TensionPreconditioner& tension;

  void vmult(Blocks& result, const Blocks& x) const {
    stokes.matrix().precondition(result, x);
    InextensibleSystem::set_tension(tension.apply(on_all_ranks(x.block(tension_block))), result);
  }
};

}  // namespace

InextensibleFlow solve_inextensible_flow(const Discretisation& discretisation, const FlowProblem& problem) {
  Stopwatch watch;
  const StokesSystem stokes(discretisation, {problem.viscosity_in, problem.viscosity_out});
  const Space& space = stokes.space();
  const int degree = discretisation.degree();
  const auto elements = std::make_shared<const TensionElements>(*space.mesh, degree, degree - 1);
  const bool constant_is_determined = elements->variation_of_curvature() > least_variation;
  const TensionPreconditioner tension_preconditioner(*elements, problem.viscosity_in, problem.viscosity_out,
                                                     !constant_is_determined);
  const InextensibleSystem system(stokes, *elements);

  Blocks b = system.zero();
  const Blocks flow_right_side = stokes.right_side(problem);
  for (unsigned block = 0; block < tension_block; ++block) b.block(block) = flow_right_side.block(block);
  InextensibleSystem::set_tension(-elements->divergence_of_linear_flow(problem.gradient), b);
  // Without a force on the fluid, minimal residuals would break down in its first step: the residual would have no part
  // in the equation of momentum, and the matrix has nothing on the diagonal of the others. So it starts from a tension.
  Blocks x = system.zero();
  InextensibleSystem::set_tension(tension_preconditioner.apply(on_all_ranks(b.block(tension_block))), x);
  Blocks residual = system.zero();
  system.vmult(residual, x);
  residual.sadd(-1.0, 1.0, b);
  Cost cost;
  x += minimal_residuals(system, InextensiblePreconditioner{stokes, tension_preconditioner}, residual,
                         problem.tolerance, cost.iterations);
  cost.seconds_solve = watch.lap() - stokes.matrix().seconds_assembly();

  const Vector tension = on_all_ranks(x.block(tension_block));
  Eigen::MatrixX3d force(space.trace->size(), 3);
  for (int d = 0; d < 3; ++d) {
    force.col(d) = space.trace->project(system.in_pairs(-(elements->divergence()[d].transpose() * tension)));
  }
  return InextensibleFlow(std::make_shared<const InextensibleFlow::Data>(InextensibleFlow::Data{
      stokes.solution(problem, x, cost), space.trace, elements,
      constant_is_determined ? tension : elements->without_mean(tension), force, constant_is_determined}));
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
