#include "bie/physics/background_flow.hpp"

namespace vehd {

BackgroundFlow shear_flow(double rate) {
  BackgroundFlow flow;
  flow.gradient(0, 2) = rate;
  return flow;
}

BackgroundFlow planar_extension(double rate) {
  BackgroundFlow flow;
  flow.gradient(0, 0) = rate;
  flow.gradient(2, 2) = -rate;
  return flow;
}

BackgroundFlow axisymmetric_extension(double rate) {
  BackgroundFlow flow;
  flow.gradient.diagonal() << -0.5 * rate, -0.5 * rate, rate;
  return flow;
}

}  // namespace vehd
