#include "bie/stepping/time/past.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/remap.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// One degree of x, or of a scalar, at the times of a past.
class PastOfDegree {
 public:
  /// @param first, count  its columns among those of one time
  PastOfDegree(const Vector& times, Matrix& past, int degree, Index first, Index count)
      : times_(times), past_(past), degree_(degree), first_(first), count_(count) {}

  /// Keeps the values at the latest times that belong to a smooth motion and replaces earlier ones by the polynomial
  /// through them.
  void smooth() {
    const double ahead = -times_[0];
    Index kept = 1;
    Matrix continued = polynomial(1, ahead);
    double added = continued.norm();
    while (kept < times_.size()) {
      Matrix next = polynomial(kept + 1, ahead);
      const double more = (next - continued).norm();
      if (!(more <= added)) break;
      added = more;
      continued = std::move(next);
      ++kept;
    }
    for (Index j = 0; j < times_.size() - kept; ++j) at(j) = polynomial(kept, times_[j]);
  }

 private:
  [[nodiscard]] Eigen::Block<Matrix> at(Index j) {
    const Index n_columns = past_.cols() / times_.size();
    return past_.block(coefficient_index(degree_, -degree_), j * n_columns + first_, 2 * degree_ + 1, count_);
  }
  /// Value at x of the polynomial through the present and this many of the latest times.
  [[nodiscard]] Matrix polynomial(Index n_latest, double x) {
    const Vector weights = weights_from_zero(times_.tail(n_latest), x);
    Matrix sum = Matrix::Zero(2 * degree_ + 1, count_);
    for (Index j = 0; j < n_latest; ++j) sum += weights[j] * at(times_.size() - n_latest + j);
    return sum;
  }

  const Vector& times_;
  Matrix& past_;
  int degree_;
  Index first_, count_;
};

}  // namespace

Matrix smooth_past(const Vector& times, Matrix past) {
  const Index n_columns = past.cols() / times.size();
  const int order = order_of(past.rows());
  for (int degree = 0; degree <= order; ++degree) {
    PastOfDegree(times, past, degree, 0, 3).smooth();
    for (Index column = 3; column < n_columns; ++column) PastOfDegree(times, past, degree, column, 1).smooth();
  }
  return past;
}

namespace {

/// Past of one vesicle, for messages between ranks.
struct SentPast {
  Matrix past{};
};

template <MaybeConst<SentPast> Sent, typename Visit>
void visit_members(Sent& sent, Visit& visit) {
  visit(sent.past);
}

}  // namespace

bool can_extrapolate(const State& state, double dt) {
  const Vector& times = state.past_times;
  return times.size() > 0 && dt <= -thresholds::longest_extrapolation * times[0];
}

NodeSolution extrapolated(const StepStart& start, double time) {
  const Vector weights = weights_from_zero(start.state.past_times, time - start.state.time);
  NodeSolution result{time, std::vector<Motion>(start.state.vesicles.size())};
  const Exchange& exchange = start.discretisation.symmetry().exchange;
  for (std::size_t a = 0; a < start.state.vesicles.size(); ++a) {
    if (exchange.is_image(a)) continue;
    SurfaceFields fields = start.state.vesicles[a];
    const Matrix& past = start.state.vesicles[a].past;
    const Index n_columns = past.cols() / weights.size();
    for (Index j = 0; j < weights.size(); ++j) {
      for_each_block<Unknowns>(fields, [&](auto& field, Index first) {
        field += weights[j] * past.middleCols(j * n_columns + first, field.cols());
      });
    }
    if (start.model.mobile) fields.tension = start.solved.fields.vesicles[a].tension;
    result.vesicles[a].material = symmetric_part(start.discretisation.vesicle(a).subspace(), std::move(fields));
  }
  for (std::size_t a = 0; a < start.state.vesicles.size(); ++a) {
    Motion& motion = result.vesicles[a];
    if (exchange.is_image(a))
      motion.material = image_of(exchange.image(a), result.vesicles[exchange.original(a)].material);
    motion.arrived = motion.material;
  }
  return result;
}

void store_past(const StepStart& start, const std::vector<NodeSolution>& nodes, State& state) {
  const NodeSolution& end = nodes.back();
  state.past_times = {};
  if (std::ranges::any_of(start.solved.vesicles, &VesicleSolution::is_sphere)) return;
  const auto n_times = std::ssize(nodes);
  Vector times(n_times);
  times[0] = start.state.time - end.time;
  for (Index j = 1; j < n_times; ++j) times[j] = nodes[static_cast<std::size_t>(j - 1)].time - end.time;
  std::vector<SentPast> all(start.state.vesicles.size());
  for_each_member(start.discretisation.partition().local_indices(all.size()), [&](std::size_t a) {
    const SurfaceFields& from = start.state.vesicles[a];
    const SurfaceFields& to = end.vesicles[a].material;
    const Matrix now = columns_of<Unknowns>(to);
    Matrix past(now.rows(), n_times * now.cols());
    for (Index j = 0; j < n_times; ++j) {
      const Matrix then =
          columns_of<Unknowns>(j == 0 ? from : nodes[static_cast<std::size_t>(j - 1)].vesicles[a].material);
      past.middleCols(j * now.cols(), now.cols()) = then - now;
    }
    const SphereTransform& fine = start.discretisation.vesicle(a).fine_transform();
    all[a].past = smooth_past(times, GridMove(fine, to.position - from.position, to.position).carried(past));
  });
  // Images have no past: they follow the extrapolation of their originals.
  start.discretisation.partition().gather(all, [](const SentPast&, std::size_t) { return SentPast{}; });
  for (std::size_t a = 0; a < all.size(); ++a) state.vesicles[a].past = std::move(all[a].past);
  state.past_times = std::move(times);
}

}  // namespace vehd
