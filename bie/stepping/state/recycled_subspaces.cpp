#include "bie/stepping/state/recycled_subspaces.hpp"

#include <fmt/format.h>

#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Recycling pauses after a step with more than this many times the iterations of one without recycling. Measured.
constexpr double slowed_by_recycling = 2.0;
/// Steps until recycling is tried again: at two steps in fifty a useless trial costs a few percent of a run. Measured.
constexpr std::int64_t steps_without_recycling = 50;

}  // namespace

RecycledScalars::RecycledScalars(std::vector<Index> entries, RecycledSubspace subspace)
    : entries_(std::move(entries)), subspace_(std::move(subspace)) {
  const auto n = static_cast<Index>(entries_.size());
  const Index rows = subspace_.arguments.rows();
  if (n == 0 || rows % n != 0 || subspace_.responses.rows() != rows ||
      subspace_.responses.cols() != subspace_.count()) {
    throw ShapeError(fmt::format("recycled columns have {} and {} rows, which are not those of whole scalars of {}",
                                 rows, subspace_.responses.rows(), n));
  }
}

RecycledSubspace RecycledScalars::in(const std::vector<Index>& entries, Index n_scalars) const {
  const bool same = entries == entries_ && subspace_.arguments.rows() == n_scalars * static_cast<Index>(entries.size());
  return same ? subspace_ : RecycledSubspace{};
}

std::shared_ptr<const RecycledScalars> recycled_scalars(const std::vector<Index>& entries, RecycledSubspace subspace) {
  return subspace.count() == 0 ? nullptr : std::make_shared<const RecycledScalars>(entries, std::move(subspace));
}

void visit_members(const SentScalars& sent, Packing& packing) {
  const bool any = sent.known != nullptr;
  packing(any);
  if (any) packing(sent.known->entries(), sent.known->subspace().arguments, sent.known->subspace().responses);
}

void visit_members(SentScalars& sent, Unpacking& unpacking) {
  bool any = false;
  unpacking(any);
  sent.known = nullptr;
  if (!any) return;
  std::vector<Index> entries;
  RecycledSubspace subspace;
  unpacking(entries, subspace.arguments, subspace.responses);
  sent.known = std::make_shared<const RecycledScalars>(std::move(entries), std::move(subspace));
}

RecycledSubspaces after_step(const RecycledSubspaces& before, std::shared_ptr<const RecycledScalars> flow,
                             int iterations) {
  RecycledSubspaces after = before;
  if (!before.flow) {
    after.unaided_iterations = iterations;
    if (after.pause > 0) --after.pause;
  } else if (iterations > slowed_by_recycling * static_cast<double>(before.unaided_iterations)) {
    after.pause = steps_without_recycling;
  }
  after.flow = after.pause > 0 ? nullptr : std::move(flow);
  return after;
}

}  // namespace vehd
