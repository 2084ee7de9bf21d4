#include "bie/physics/waveform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Times this close, relative to their size or to the duration of the waveform, count as equal: steps that end on a
/// discontinuity do so only up to rounding.
constexpr double kSameTime = 1e-11;
/// Factors this close, relative to the largest, count as equal: a table is interpolated on both sides of its times.
constexpr double kSameFactor = 1e-9;

}  // namespace

Waveform Waveform::alternating(double amplitude, double frequency, double phase) {
  Waveform w(Kind::alternating, amplitude);
  w.frequency_ = frequency;
  w.phase_ = phase;
  return w;
}

Waveform Waveform::burst(double amplitude, double frequency, double phase, double start, double duration) {
  Waveform w = alternating(amplitude, frequency, phase);
  w.kind_ = Kind::burst;
  w.start_ = start;
  w.duration_ = duration;
  return w;
}

Waveform Waveform::pulse(double amplitude, double start, double duration) {
  Waveform w(Kind::pulse, amplitude);
  w.start_ = start;
  w.duration_ = duration;
  return w;
}

Waveform Waveform::pulse_train(double amplitude, double start, double duration, double period) {
  if (duration >= period) throw InputError("the pulses of a train must be shorter than its period");
  Waveform w = pulse(amplitude, start, duration);
  w.kind_ = Kind::pulse_train;
  w.period_ = period;
  return w;
}

Waveform Waveform::table(std::vector<double> times, std::vector<double> values) {
  if (times.size() < 2 || times.size() != values.size() || !std::is_sorted(times.begin(), times.end())) {
    throw InputError("a waveform table needs two or more rows of time and value with ascending times");
  }
  Waveform w;
  w.kind_ = Kind::table;
  w.times_ = std::move(times);
  w.values_ = std::move(values);
  // The largest factor.
  w.amplitude_ = 0.0;
  for (const double value : w.values_) w.amplitude_ = std::max(w.amplitude_, std::abs(value));
  return w;
}

double Waveform::slack(double time) const {
  const double span = kind_ == Kind::table ? times_.back() - times_.front() : duration_;
  return kSameTime * std::max(span, std::abs(time));
}

double Waveform::oscillation(double time) const {
  return amplitude_ * std::cos(2.0 * std::numbers::pi * frequency_ * time + phase_);
}

double Waveform::at(double time, Limit limit) const {
  const double shifted = limit == Limit::after ? time + slack(time) : time - slack(time);
  switch (kind_) {
    case Kind::constant:
      return 1.0;
    case Kind::alternating:
      return oscillation(time);
    case Kind::burst:
      return shifted > start_ && shifted < start_ + duration_ ? oscillation(time) : 0.0;
    case Kind::pulse:
      return shifted > start_ && shifted < start_ + duration_ ? amplitude_ : 0.0;
    case Kind::pulse_train: {
      if (shifted < start_) return 0.0;
      const double since = shifted - start_;
      return since - std::floor(since / period_) * period_ < duration_ ? amplitude_ : 0.0;
    }
    case Kind::table:
      break;
  }
  const auto next = std::upper_bound(times_.begin(), times_.end(), shifted);
  if (next == times_.begin()) return values_.front();
  if (next == times_.end()) return values_.back();
  const auto i = static_cast<std::size_t>(next - times_.begin());
  const double part = std::clamp((time - times_[i - 1]) / (times_[i] - times_[i - 1]), 0.0, 1.0);
  return values_[i - 1] + part * (values_[i] - values_[i - 1]);
}

std::optional<double> Waveform::next_discontinuity(double time) const {
  const double after = time + slack(time);
  switch (kind_) {
    case Kind::constant:
    case Kind::alternating:
      return std::nullopt;
    case Kind::burst:
    case Kind::pulse:
      if (start_ > after) return start_;
      if (start_ + duration_ > after) return start_ + duration_;
      return std::nullopt;
    case Kind::pulse_train: {
      const double k = std::max(0.0, std::floor((after - start_) / period_));
      for (const double discontinuity : {start_ + k * period_, start_ + k * period_ + duration_}) {
        if (discontinuity > after) return discontinuity;
      }
      return start_ + (k + 1.0) * period_;
    }
    case Kind::table:
      break;
  }
  const auto next = std::upper_bound(times_.begin(), times_.end(), after);
  return next == times_.end() ? std::nullopt : std::optional(*next);
}

bool Waveform::jumps_at(double time) const {
  return std::abs(at(time, Limit::after) - at(time, Limit::before)) > kSameFactor * std::abs(amplitude_);
}

bool Waveform::is_quiet(double time) const {
  if (kind_ == Kind::constant) return false;
  if (kind_ == Kind::alternating) return amplitude_ == 0.0;
  const std::optional<double> discontinuity = next_discontinuity(time);
  // Zeros of the oscillation do not make a burst quiet.
  if (kind_ == Kind::burst) return !discontinuity || *discontinuity == start_;
  return at(time) == 0.0 && (!discontinuity || at(*discontinuity, Limit::before) == 0.0);
}

}  // namespace vehd
