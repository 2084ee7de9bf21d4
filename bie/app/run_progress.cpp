#include "bie/app/run_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace vehd {

void show_run(Progress& progress, const RunStatus& status) {
  const double done = status.time - status.start_time;
  const std::string left =
      done > 0.0 ? duration_text(status.seconds / done * std::max(0.0, status.end_time - status.time)) : "?";
  const std::string unit = status.time_unit.empty() ? "" : " " + status.time_unit;
  const std::string gap = status.gap.empty() ? "" : "  gap " + status.gap;
  progress.update(status.end_time > 0.0 ? status.time / status.end_time : 1.0,
                  fmt::format("step {}  t {:.4g}/{:.4g}{}  dt {:.3g}  drift {:.1e}{}  left {}", status.step,
                              status.time, status.end_time, unit, status.dt, status.drift, gap, left));
}

}  // namespace vehd
