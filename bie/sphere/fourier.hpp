#pragma once

#include <fftw3.h>

#include <memory>

#include "bie/support/types.hpp"

namespace vehd {

/// Fourier sums in φ for all latitudes of one field at once: f(φ) = Σ_m (C_m cos mφ + S_m sin mφ). A spectrum is a
/// [n_theta x (n_phi/2 + 1)] complex matrix with entries C_m − i S_m.
/// Plans are made with FFTW_ESTIMATE: a measured plan may differ from run to run, and so would the last bits.
/// Accuracy: rounding; round trips of the transform to 2e-13 (tests/sphere/transform_test.cpp)
/// Source: FFTW (Frigo and Johnson 2005)
class FourierPlan {
 public:
  /// @param n_theta  rows that are transformed together
  /// @param n_phi    even
  FourierPlan(int n_theta, int n_phi);

  /// @param spectrum  overwritten; sines at m = 0 and m = n_phi/2 must be zero
  /// @param values    [n_theta * n_phi], φ fastest
  void synthesize(Eigen::Ref<Eigen::MatrixXcd> spectrum, double* values) const;
  /// The spectrum of values.
  /// @param values  left intact
  [[nodiscard]] Eigen::MatrixXcd analyze(const double* values) const;

 private:
  struct Destroy {
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
  };
  using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Destroy>;

  int n_theta_;
  int n_phi_;
  Plan backward_;
  Plan forward_;
};

}  // namespace vehd
