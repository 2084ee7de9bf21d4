#pragma once

#include <utility>
#include <vector>

namespace vehd::fem_check {

/// A value for each vesicle; a single value applies to all of them.
template <typename Value>
class PerVesicle {
 public:
  // Implicit, since most problems have one vesicle or equal values for all.
  PerVesicle(Value of_all) : values_{std::move(of_all)} {}
  PerVesicle(std::vector<Value> of_each) : values_(std::move(of_each)) {}

  const Value& operator[](int vesicle) const {
    return values_[values_.size() == 1 ? 0 : static_cast<std::size_t>(vesicle)];
  }
  /// The stored values: one for all, or one for each vesicle.
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }

 private:
  std::vector<Value> values_;
};

/// The values f(0), …, f(n_vesicles − 1).
template <typename Function>
auto per_vesicle(int n_vesicles, const Function& of_vesicle) {
  std::vector<decltype(of_vesicle(0))> values;
  for (int vesicle = 0; vesicle < n_vesicles; ++vesicle) values.push_back(of_vesicle(vesicle));
  return PerVesicle<decltype(of_vesicle(0))>(std::move(values));
}

}  // namespace vehd::fem_check
