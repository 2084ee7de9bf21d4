#include "bie/estimate/file_cost.hpp"

#include "bie/scene/problem.hpp"

namespace vehd {

double file_seconds(const Scene& scene, std::int64_t steps, int order) {
  constexpr double kPerRow = 2e-4, kPerSnapshot = 2e-3, kPerPoint = 1.4e-6;
  const double snapshots = 2.0 + events_of(scene).snapshots.count(scene.numerics.end_time);
  return kPerRow * static_cast<double>(steps) + snapshots * (kPerSnapshot + kPerPoint * 2.0 * order * order);
}

}  // namespace vehd
