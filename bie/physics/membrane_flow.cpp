#include "bie/physics/membrane_flow.hpp"

#include "bie/linear/recycled_gcr.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// The error of a solve inside another one is negligible at the tolerance of the outer solve.
constexpr SolveOptions kWithinSolve{1e-12, 100};

}  // namespace

PairSelection flow_pair_selection(const FlowParameters& parameters) {
  return {.stokes_single = true, .stokes_double = parameters.viscosity_ratio != 1.0};
}

MembraneFlow::MembraneFlow(const std::vector<FlowMembrane>& membranes, const Interaction& interaction)
    : membranes_(membranes), interaction_(interaction), contrast_(false) {
  if (interaction.is_empty()) return;
  for (const FlowMembrane& one : membranes) contrast_ = contrast_ || one.parameters.viscosity_ratio != 1.0;
  if (!contrast_) return;
  for (const FlowMembrane& one : membranes) {
    stacked_.add(one.membrane.subspace.n_coefficients(), 3, one.membrane.subspace.vectors());
  }
  const LinearMap map = [&membranes, &interaction, stacked = stacked_](const Vector& v) -> Vector {
    std::vector<Matrix> jumps = stacked.fields<Matrix>(v);
    for (std::size_t b = 0; b < jumps.size(); ++b) {
      const double ratio = membranes[b].parameters.viscosity_ratio;
      jumps[b] = ratio == 1.0 ? Matrix() : Matrix((1.0 - ratio) * jumps[b]);
    }
    std::vector<Matrix> of_others = interaction.stokes_double(jumps);
    for_each_member(interaction.partition().local_indices(of_others.size()),
                    [&](std::size_t a) { of_others[a] = membranes[a].membrane.velocity(std::move(of_others[a])); });
    interaction.gather_vectors(of_others);
    return v - stacked.stack(of_others);
  };
  solver_ = std::make_unique<RecycledGcr>(
      map, [](const Vector& r) { return r; }, stacked_.size());
}

MembraneFlow::~MembraneFlow() = default;
MembraneFlow::MembraneFlow(MembraneFlow&&) noexcept = default;

std::vector<Matrix> MembraneFlow::velocities(const std::vector<Matrix>& weighted,
                                             const std::vector<Matrix>& background) {
  std::vector<Matrix> result =
      interaction_.is_empty() ? std::vector<Matrix>(weighted.size()) : interaction_.stokes_single(weighted);
  for_each_member(interaction_.partition().local_indices(result.size()), [&](std::size_t a) {
    const Membrane& membrane = membranes_[a].membrane;
    if (result[a].size() == 0) result[a] = Matrix::Zero(n_coefficients(membrane.fine.order()), 3);
    if (weighted[a].size() > 0 && !membrane.layers.stokes_single.empty())
      result[a] += membrane.layers.stokes_single.apply(weighted[a]);
    result[a] /= membranes_[a].parameters.viscosity;
    if (!background.empty()) result[a] += background[a];
    result[a] = membrane.velocity(std::move(result[a]));
  });
  if (!contrast_) return result;
  interaction_.gather_vectors(result);
  const RecycledGcr::Solution solution = solver_->solve(stacked_.stack(result), {}, kWithinSolve);
  require_converged(solution.report, "velocities of membranes with a viscosity contrast");
  return stacked_.fields<Matrix>(solution.x);
}

}  // namespace vehd
