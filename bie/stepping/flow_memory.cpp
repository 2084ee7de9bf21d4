#include "bie/stepping/flow_memory.hpp"

#include <fmt/format.h>

#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {

ScalarResponses::ScalarResponses(std::vector<Index> entries, KnownResponses known)
    : entries_(std::move(entries)), known_(std::move(known)) {
  const auto n = static_cast<Index>(entries_.size());
  const Index rows = known_.arguments.rows();
  if (n == 0 || rows % n != 0 || known_.responses.rows() != rows || known_.responses.cols() != known_.count()) {
    throw ShapeError(fmt::format("known responses have {} and {} rows, which are not those of whole scalars of {}",
                                 rows, known_.responses.rows(), n));
  }
}

KnownResponses ScalarResponses::in(const std::vector<Index>& entries, Index n_scalars) const {
  const bool same = entries == entries_ && known_.arguments.rows() == n_scalars * static_cast<Index>(entries.size());
  return same ? known_ : KnownResponses{};
}

std::shared_ptr<const ScalarResponses> remembered(const std::vector<Index>& entries, KnownResponses known) {
  return known.count() == 0 ? nullptr : std::make_shared<const ScalarResponses>(entries, std::move(known));
}

FlowMemory memory_after_step(const FlowMemory& before, std::shared_ptr<const ScalarResponses> known, int iterations) {
  constexpr double kWorthwhile = 2.0;
  constexpr std::int64_t kPause = 50;
  FlowMemory after = before;
  if (!before.flow) {
    after.unaided_iterations = iterations;
    if (after.pause > 0) --after.pause;
  } else if (iterations > kWorthwhile * static_cast<double>(before.unaided_iterations)) {
    after.pause = kPause;
  }
  after.flow = after.pause > 0 ? nullptr : std::move(known);
  return after;
}

}  // namespace vehd
