#include "bie/sphere/fourier.hpp"

#include <mutex>

namespace vehd {

namespace {

/// FFTW's planner is the one part of it that is not thread safe.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

FourierPlan::FourierPlan(int n_theta, int n_phi) : n_theta_(n_theta), n_phi_(n_phi) {
  const std::scoped_lock lock(planner_mutex());
  Eigen::MatrixXcd spectrum(n_theta, n_phi / 2 + 1);
  Vector values(Index{n_theta} * n_phi);
  auto* complex = reinterpret_cast<fftw_complex*>(spectrum.data());
  const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  backward_.reset(fftw_plan_many_dft_c2r(1, &n_phi, n_theta, complex, nullptr, n_theta, 1, values.data(), nullptr, 1,
                                         n_phi, flags));
  forward_.reset(fftw_plan_many_dft_r2c(1, &n_phi, n_theta, values.data(), nullptr, 1, n_phi, complex, nullptr, n_theta,
                                        1, flags | FFTW_PRESERVE_INPUT));
}

void FourierPlan::synthesize(Eigen::Ref<Eigen::MatrixXcd> spectrum, double* values) const {
  spectrum.middleCols(1, n_phi_ / 2 - 1) *= 0.5;
  fftw_execute_dft_c2r(backward_.get(), reinterpret_cast<fftw_complex*>(spectrum.data()), values);
}

Eigen::MatrixXcd FourierPlan::analyze(const double* values) const {
  Eigen::MatrixXcd spectrum(n_theta_, n_phi_ / 2 + 1);
  fftw_execute_dft_r2c(forward_.get(), const_cast<double*>(values), reinterpret_cast<fftw_complex*>(spectrum.data()));
  spectrum *= 2.0 / n_phi_;
  spectrum.col(0) *= 0.5;
  spectrum.col(n_phi_ / 2) *= 0.5;
  return spectrum;
}

}  // namespace vehd
