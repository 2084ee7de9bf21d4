#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace vehd {

/// Operation counters and accumulated wall times of one run, passed explicitly to whatever does counted work.
/// Not thread safe: parallel regions count once, outside.
class Instruments {
 public:
  /// Adds the time between construction and destruction to one entry.
  class ScopedTimer {
   public:
    explicit ScopedTimer(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
    ~ScopedTimer() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    ScopedTimer(const ScopedTimer&) = delete;
    ScopedTimer& operator=(const ScopedTimer&) = delete;

   private:
    double& seconds_;
    std::chrono::steady_clock::time_point start_;
  };

  /// Kernel evaluations are counted one per (target, quadrature node) pair, whatever the number of components.
  void count_kernel(const std::string& kernel, std::uint64_t evaluations) { kernels_[kernel] += evaluations; }
  [[nodiscard]] ScopedTimer time(const std::string& part) { return ScopedTimer(seconds_[part]); }

  const std::map<std::string, std::uint64_t>& kernel_evaluations() const { return kernels_; }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, std::uint64_t> kernels_;
  std::map<std::string, double> seconds_;
};

}  // namespace vehd
