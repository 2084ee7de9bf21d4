#include <algorithm>
#include <iterator>
#include <utility>

#include "bie/stepping/space/remap.hpp"
#include "bie/stepping/state/exchange.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/smooth_past.hpp"
#include "bie/stepping/time/step_operations.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Of one vesicle.
struct SentPast {
  Matrix past{};
};

template <MaybeConst<SentPast> Sent, typename Visit>
void visit_members(Sent& sent, Visit& visit) {
  visit(sent.past);
}

}  // namespace

bool StepOperations::can_extrapolate(double dt) const {
  const Vector& times = start_.past_times;
  return times.size() > 0 && dt <= -thresholds::longest_continuation * times[0];
}

NodeSolution StepOperations::extrapolated(double time) const {
  const Vector weights = weights_from_zero(start_.past_times, time - start_.time);
  NodeSolution result{time, std::vector<Motion>(start_.vesicles.size())};
  const Exchange& exchange = discretisation_.symmetry().exchange;
  for (std::size_t a = 0; a < start_.vesicles.size(); ++a) {
    if (exchange.is_image(a)) continue;
    SurfaceFields fields = start_.vesicles[a];
    const Matrix& past = start_.vesicles[a].past;
    const Index n_columns = past.cols() / weights.size();
    for (Index j = 0; j < weights.size(); ++j) {
      for_each_block<Unknowns>(fields, [&](auto& field, Index first) {
        field += weights[j] * past.middleCols(j * n_columns + first, field.cols());
      });
    }
    if (model_.mobile) fields.tension = at_start_.fields.vesicles[a].tension;
    result.vesicles[a].material = symmetric_part(discretisation_.vesicle(a).subspace(), std::move(fields));
  }
  for (std::size_t a = 0; a < start_.vesicles.size(); ++a) {
    Motion& motion = result.vesicles[a];
    if (exchange.is_image(a))
      motion.material = image_of(exchange.image(a), result.vesicles[exchange.original(a)].material);
    motion.arrived = motion.material;
  }
  return result;
}

void StepOperations::store_past(const std::vector<NodeSolution>& nodes, State& state) const {
  const NodeSolution& end = nodes.back();
  state.past_times = {};
  if (std::ranges::any_of(at_start_.vesicles, &VesicleSolution::is_sphere)) return;
  const auto n_times = std::ssize(nodes);
  Vector times(n_times);
  times[0] = start_.time - end.time;
  for (Index j = 1; j < n_times; ++j) times[j] = nodes[static_cast<std::size_t>(j - 1)].time - end.time;
  std::vector<SentPast> all(start_.vesicles.size());
  for_each_member(shares().own(all.size()), [&](std::size_t a) {
    const SurfaceFields& from = start_.vesicles[a];
    const SurfaceFields& to = end.vesicles[a].material;
    const Matrix now = columns_of<Unknowns>(to);
    Matrix past(now.rows(), n_times * now.cols());
    for (Index j = 0; j < n_times; ++j) {
      const Matrix then =
          columns_of<Unknowns>(j == 0 ? from : nodes[static_cast<std::size_t>(j - 1)].vesicles[a].material);
      past.middleCols(j * now.cols(), now.cols()) = then - now;
    }
    const SphereTransform& fine = discretisation_.vesicle(a).fine_transform();
    all[a].past = smooth_past(times, GridMove(fine, to.position - from.position, to.position).carried(past));
  });
  // Images have that of their originals.
  shares().gather(all, [](const SentPast&, std::size_t) { return SentPast{}; });
  for (std::size_t a = 0; a < all.size(); ++a) state.vesicles[a].past = std::move(all[a].past);
  state.past_times = std::move(times);
}

}  // namespace vehd
