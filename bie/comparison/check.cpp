#include "bie/comparison/check.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "bie/comparison/check_input.hpp"
#include "bie/comparison/check_samples.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// Beyond it the quick check would not be quick; an order above it is kept.
constexpr int highest_quick_order = 28;

int high_order(int order, bool quick) {
  // Boundary integrals are cheap beside fine elements; their error must not be what the comparison ends on.
  const int raised = quick ? (3 * order + 1) / 2 : 2 * order;
  return std::clamp(raised, std::min(order + 2, highest_order),
                    quick ? std::max(highest_quick_order, order + 2) : highest_order);
}

}  // namespace

FemProgram::Result compare_methods(const FemProgram& fem, const CheckTask& task) {
  const FrozenState& frozen = task.frozen;
  const CheckContents contents = check_contents(frozen);
  const Matrix force = contents.flow ? given_force(frozen) : Matrix();
  make_directory(task.directory);
  const CheckSamples samples = check_samples(frozen.state.vesicles.front().position);
  const auto solved_at = [&](int order) {
    CheckFields fields = check_fields(frozen, contents, force, order, samples.points);
    if (task.tell) task.tell(fields);
    return fields;
  };
  const int order = order_of(frozen.state.vesicles.front().position.rows());
  const CheckFields at_order = solved_at(order);
  const CheckFields at_high_order = solved_at(high_order(order, task.quick));
  const std::filesystem::path input = task.directory / "check_input.h5";
  write_check_input(input, {frozen, contents, force, samples, at_order, at_high_order});

  std::vector<std::string> arguments{"check", input.string(), "-o", task.directory.string()};
  if (task.quick) arguments.emplace_back("--quick");
  return fem.run(arguments, task.n_ranks);
}

}  // namespace vehd
