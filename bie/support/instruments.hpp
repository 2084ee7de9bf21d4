#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace vehd {

/// Observer of the beginning and end of parts of the work; parts may be nested.
class PartObserver {
 public:
  virtual ~PartObserver() = default;
  /// A part begins, within all those that have begun and not ended.
  virtual void begin(const std::string& part) = 0;
  /// The innermost part ends.
  virtual void end() = 0;
};

/// Operation counters and accumulated wall times of one run, passed explicitly to all code that does counted work.
/// Not thread safe: parallel regions count once, outside.
class Instruments {
 public:
  /// @param observer  must outlive this; null: none
  explicit Instruments(PartObserver* observer = nullptr) : observer_(observer) {}
  Instruments(const Instruments&) = delete;
  Instruments& operator=(const Instruments&) = delete;

  /// Adds the time between construction and destruction to one part and subtracts it from the enclosing part, so that
  /// the parts add up to the time spent in any of them.
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

  /// Counts kernel evaluations, one per (target, quadrature node) pair whatever the number of components.
  void count_kernel(const std::string& kernel, std::uint64_t evaluations) { kernels_[kernel] += evaluations; }
  /// Counts targets on one membrane of the layers of another, by the method of evaluation ("near", "far", "expanded").
  void count_pair_targets(const std::string& way, std::uint64_t targets) { pair_targets_[way] += targets; }
  /// Times a part until the end of the scope.
  [[nodiscard]] ScopedTimer time(const std::string& part) { return {*this, part}; }

  /// Adds the counts of instruments whose work ran concurrently on threads. Each part gets its share of their joint
  /// wall time, which is subtracted from the enclosing part.
  template <class Others>
  void take_side_by_side(const Others& others, double wall_seconds) {
    double sum = 0.0;
    for (const Instruments& other : others) {
      for (const auto& [kernel, evaluations] : other.kernels_) kernels_[kernel] += evaluations;
      for (const auto& [way, targets] : other.pair_targets_) pair_targets_[way] += targets;
      for (const auto& [part, seconds] : other.seconds_) sum += seconds;
    }
    if (!(sum > 0.0)) return;
    for (const Instruments& other : others) {
      for (const auto& [part, seconds] : other.seconds_) seconds_[part] += wall_seconds * seconds / sum;
    }
    if (running_ != nullptr) *running_ -= wall_seconds;
  }

  /// Evaluations so far by the name of the kernel.
  const std::map<std::string, std::uint64_t>& kernel_evaluations() const { return kernels_; }
  /// Targets of pairs so far by the method of evaluation.
  const std::map<std::string, std::uint64_t>& pair_targets() const { return pair_targets_; }
  /// Wall time so far by the name of the part.
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, std::uint64_t> kernels_, pair_targets_;
  std::map<std::string, double> seconds_;
  double* running_ = nullptr;
  PartObserver* observer_;
};

}  // namespace vehd
