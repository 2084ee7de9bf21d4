#include "bie/sphere/fast_fourier.hpp"

#include <complex>
#include <mutex>
#include <vector>

namespace vehd {

namespace {

using Spectrum = std::vector<std::complex<double>>;

/// The planner is the only part of FFTW that is not thread safe.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

Spectrum empty_spectrum(int n_phi) { return Spectrum(static_cast<std::size_t>(n_phi / 2 + 1)); }

fftw_complex* data_of(Spectrum& spectrum) { return reinterpret_cast<fftw_complex*>(spectrum.data()); }

}  // namespace

FastFourier::FastFourier(int n_phi, int order) : n_phi_(n_phi), order_(order) {
  const std::scoped_lock lock(planner_mutex());
  Spectrum spectrum = empty_spectrum(n_phi);
  std::vector<double> values(static_cast<std::size_t>(n_phi));
  const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  const auto destroy = [](fftw_plan plan) {
    const std::scoped_lock planner(planner_mutex());
    fftw_destroy_plan(plan);
  };
  backward_ = Plan(fftw_plan_dft_c2r_1d(n_phi, data_of(spectrum), values.data(), flags), destroy);
  forward_ = Plan(fftw_plan_dft_r2c_1d(n_phi, values.data(), data_of(spectrum), flags | FFTW_PRESERVE_INPUT), destroy);
}

void FastFourier::synthesize(Index rows, const double* amplitudes, Index stride, double* values) const {
  Spectrum spectrum;
  for (Index row = 0; row < rows; ++row) {
    // The inverse transform overwrites its input.
    spectrum.assign(static_cast<std::size_t>(n_phi_ / 2 + 1), 0.0);
    spectrum[0] = amplitudes[row];
    for (int m = 1; m <= order_; ++m) {
      const double cosine = amplitudes[m * stride + row], sine = amplitudes[(order_ + m) * stride + row];
      spectrum[static_cast<std::size_t>(m)] = {0.5 * cosine, -0.5 * sine};
    }
    fftw_execute_dft_c2r(backward_.get(), data_of(spectrum), values + row * n_phi_);
  }
}

void FastFourier::analyze(Index rows, const double* values, double* amplitudes) const {
  Spectrum spectrum = empty_spectrum(n_phi_);
  for (Index row = 0; row < rows; ++row, amplitudes += 2 * order_ + 1) {
    fftw_execute_dft_r2c(forward_.get(), const_cast<double*>(values + row * n_phi_), data_of(spectrum));
    amplitudes[0] = spectrum[0].real() / n_phi_;
    for (int m = 1; m <= order_; ++m) {
      const std::complex<double> mode = spectrum[static_cast<std::size_t>(m)] * (2.0 / n_phi_);
      amplitudes[m] = mode.real();
      amplitudes[order_ + m] = -mode.imag();
    }
  }
}

}  // namespace vehd
