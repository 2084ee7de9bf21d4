#include "bie/sphere/fourier.hpp"

#include <mutex>

namespace vehd {

namespace {

/// FFTW's planner is the one part of it that is not thread safe.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Longitudes of axisymmetric fields. Sines and cosines are 0 and ±1 there, and the calls of a library would cost more
/// than the sums.
constexpr int kQuarterTurns = 4;

void sum_quarter_turns(const Eigen::Ref<Eigen::MatrixXcd>& spectrum, double* values) {
  for (Index j = 0; j < spectrum.rows(); ++j, values += kQuarterTurns) {
    const double mean = spectrum(j, 0).real(), alternating = spectrum(j, 2).real();
    const double cosine = spectrum(j, 1).real(), sine = -spectrum(j, 1).imag();
    values[0] = (mean + alternating) + cosine;
    values[1] = (mean - alternating) + sine;
    values[2] = (mean + alternating) - cosine;
    values[3] = (mean - alternating) - sine;
  }
}

void find_quarter_turns(const double* values, Eigen::MatrixXcd& spectrum) {
  for (Index j = 0; j < spectrum.rows(); ++j, values += kQuarterTurns) {
    const double even = values[0] + values[2], odd = values[1] + values[3];
    spectrum(j, 0) = 0.25 * (even + odd);
    spectrum(j, 1) = {0.5 * (values[0] - values[2]), -0.5 * (values[1] - values[3])};
    spectrum(j, 2) = 0.25 * (even - odd);
  }
}

}  // namespace

FourierPlan::FourierPlan(int n_theta, int n_phi) : n_theta_(n_theta), n_phi_(n_phi) {
  if (n_phi == kQuarterTurns) return;
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
  if (n_phi_ == kQuarterTurns) {
    sum_quarter_turns(spectrum, values);
    return;
  }
  spectrum.middleCols(1, n_phi_ / 2 - 1) *= 0.5;
  fftw_execute_dft_c2r(backward_.get(), reinterpret_cast<fftw_complex*>(spectrum.data()), values);
}

Eigen::MatrixXcd FourierPlan::analyze(const double* values) const {
  Eigen::MatrixXcd spectrum(n_theta_, n_phi_ / 2 + 1);
  if (n_phi_ == kQuarterTurns) {
    find_quarter_turns(values, spectrum);
    return spectrum;
  }
  fftw_execute_dft_r2c(forward_.get(), const_cast<double*>(values), reinterpret_cast<fftw_complex*>(spectrum.data()));
  spectrum *= 2.0 / n_phi_;
  spectrum.col(0) *= 0.5;
  spectrum.col(n_phi_ / 2) *= 0.5;
  return spectrum;
}

}  // namespace vehd
