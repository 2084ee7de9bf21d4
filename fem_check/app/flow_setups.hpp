#pragma once

#include <map>

#include "fem_check/app/check_input.hpp"
#include "fem_check/flow.hpp"

namespace vehd::fem_check {

/// Operators of the flows of a check at any degree: all its flows are between the same fluids, and many have the same
/// degree.
class FlowSetups {
 public:
  explicit FlowSetups(const std::vector<CheckInput>& inputs);

  /// Made once for each degree.
  /// @param space  of one mesh in all calls
  [[nodiscard]] const FlowOperators& at(const Discretisation& space);
  /// A problem between these fluids, all else as a FlowProblem has it by itself.
  [[nodiscard]] FlowProblem problem() const;

 private:
  PerVesicle<double> viscosity_in_;
  double viscosity_out_;
  WallFlow wall_ = WallFlow::no_slip;
  std::map<int, FlowOperators> operators_;
};

}  // namespace vehd::fem_check
