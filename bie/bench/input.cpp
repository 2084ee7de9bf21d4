#include "bie/bench/input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bie/support/errors.hpp"

namespace vehd {

Scene with_fixed_steps(Scene scene, const std::string& bench) {
  if (!scene.numerics.dt) throw InputError(fmt::format("bench {} needs a scene with \"dt\" in [numerics]", bench));
  scene.numerics.tolerance.reset();
  return scene;
}

void require_ascending(const std::string& option, const std::vector<int>& values) {
  if (std::is_sorted(values.begin(), values.end())) return;
  throw InputError(fmt::format("{}: {} after a higher one; accepted: ascending", option, values.back()));
}

}  // namespace vehd
