#pragma once

#include <map>

#include "fem_check/app/check_input.hpp"
#include "fem_check/flow.hpp"

namespace vehd::fem_check {

/// Operators of the flows of a check at any degree: all flows have the same fluids, and many have the same degree.
class FlowSetups {
 public:
  explicit FlowSetups(const std::vector<CheckInput>& inputs);

  /// Operators on a discretisation, set up once for each degree.
  /// @param space  on the same mesh in all calls
  [[nodiscard]] const FlowOperators& at(const Discretisation& space);
  /// A problem with these fluids; all other members have their defaults.
  [[nodiscard]] FlowProblem problem() const;

 private:
  PerVesicle<double> viscosity_in_;
  double viscosity_out_;
  WallFlow wall_ = WallFlow::no_slip;
  std::map<int, FlowOperators> operators_;
};

}  // namespace vehd::fem_check
