#include "bie/stepping/flow_memory.hpp"

#include <utility>

namespace vehd {

FlowMemory memory_after_step(const FlowMemory& before, std::shared_ptr<const KnownResponses> known, int iterations) {
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
