#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace vehd {

/// Told when a part of the work begins and ends; parts may lie within one another.
class PartObserver {
 public:
  virtual ~PartObserver() = default;
  /// A part begins; it lies within those that have begun and not ended.
  virtual void begin(const std::string& part) = 0;
  /// The part that began last ends.
  virtual void end() = 0;
};

/// Operation counters and accumulated wall times of one run, passed explicitly to whatever does counted work.
/// Not thread safe: parallel regions count once, outside.
class Instruments {
 public:
  /// @param observer  outlives this; null: none
  explicit Instruments(PartObserver* observer = nullptr) : observer_(observer) {}
  Instruments(const Instruments&) = delete;
  Instruments& operator=(const Instruments&) = delete;

  /// Adds the time between construction and destruction to one part, and takes it from the part around it: the parts
  /// add up to the time in any of them.
  class ScopedTimer {
   public:
    ScopedTimer(Instruments& instruments, const std::string& part)
        : instruments_(instruments), seconds_(instruments.seconds_[part]), around_(instruments.running_) {
      instruments_.running_ = &seconds_;
      if (instruments_.observer_ != nullptr) instruments_.observer_->begin(part);
    }
    ~ScopedTimer() {
      const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
      seconds_ += elapsed;
      if (around_ != nullptr) *around_ -= elapsed;
      instruments_.running_ = around_;
      if (instruments_.observer_ != nullptr) instruments_.observer_->end();
    }
    ScopedTimer(const ScopedTimer&) = delete;
    ScopedTimer& operator=(const ScopedTimer&) = delete;

   private:
    Instruments& instruments_;
    double& seconds_;
    double* around_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };

  /// Kernel evaluations are counted one per (target, quadrature node) pair, whatever the number of components.
  void count_kernel(const std::string& kernel, std::uint64_t evaluations) { kernels_[kernel] += evaluations; }
  /// Times a part until the end of the scope.
  [[nodiscard]] ScopedTimer time(const std::string& part) { return {*this, part}; }

  /// Evaluations so far by the name of the kernel.
  const std::map<std::string, std::uint64_t>& kernel_evaluations() const { return kernels_; }
  /// Wall time so far by the name of the part.
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, std::uint64_t> kernels_;
  std::map<std::string, double> seconds_;
  double* running_ = nullptr;
  PartObserver* observer_;
};

}  // namespace vehd
