#pragma once

#include <optional>
#include <vector>

namespace vehd {

/// Which value to take at a jump: the one before it or the one after it.
enum class Limit { before, after };

/// Time-dependent factor of a field or a flow.
/// Times that differ by rounding, relative to their size or to the duration of the waveform, count as equal; so the
/// unit of time does not matter (tests/physics/waveform_test.cpp).
class Waveform {
 public:
  /// 1 at all times.
  Waveform() = default;
  /// amplitude · cos(2π frequency t + phase), phase in radians.
  static Waveform alternating(double amplitude, double frequency, double phase);
  /// amplitude · cos(2π frequency t + phase) during [start, start + duration), 0 otherwise.
  static Waveform burst(double amplitude, double frequency, double phase, double start, double duration);
  /// amplitude during [start, start + duration), 0 otherwise.
  static Waveform pulse(double amplitude, double start, double duration);
  /// A pulse at start, start + period, …
  /// @throws InputError unless the pulses are shorter than the period
  static Waveform pulse_train(double amplitude, double start, double duration, double period);
  /// Linear between (times, values), constant beyond its ends; equal times make a jump.
  /// @throws InputError unless there are at least two entries in ascending order
  static Waveform table(std::vector<double> times, std::vector<double> values);

  /// The factor; at a jump the value before or after it.
  [[nodiscard]] double at(double time, Limit limit = Limit::after) const;
  /// The first time after `time` at which the factor or its slope jumps: a step should end there.
  [[nodiscard]] std::optional<double> next_discontinuity(double time) const;
  /// Does the factor itself jump at this time, not only its slope?
  [[nodiscard]] bool jumps_at(double time) const;
  /// Is the factor zero from `time` up to the next discontinuity?
  [[nodiscard]] bool is_quiet(double time) const;
  bool operator==(const Waveform&) const = default;

 private:
  enum class Kind { constant, alternating, burst, pulse, pulse_train, table };

  Waveform(Kind kind, double amplitude) : kind_(kind), amplitude_(amplitude) {}

  /// Difference below which times near a discontinuity count as equal.
  [[nodiscard]] double slack(double time) const;
  [[nodiscard]] double oscillation(double time) const;

  Kind kind_ = Kind::constant;
  double amplitude_ = 1.0, frequency_ = 0.0, phase_ = 0.0;
  double start_ = 0.0, duration_ = 0.0, period_ = 0.0;
  std::vector<double> times_, values_;
};

}  // namespace vehd
