#pragma once

#include <vector>

namespace vehd::meshes {

/// Gauss–Legendre rule with n points on [−1, 1], exact to degree 2n − 1; nodes ascend.
struct GaussRule {
  std::vector<double> node;
  std::vector<double> weight;
};

GaussRule gauss_rule(int n);

}  // namespace vehd::meshes
