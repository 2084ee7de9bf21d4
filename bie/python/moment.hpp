#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd::python {

/// State and fields of a simulation at one time. It looks at those of the simulation as long as they are there, and
/// takes them over, where they lie, when the simulation goes on: arrays on them stay what they are.
class Moment {
 public:
  /// Looks at what belongs to someone else, who calls `keep` before giving it up and stays as long as this looks.
  Moment(const State& state, const Fields& fields, std::shared_ptr<const void> owner)
      : state_(&state), fields_(&fields), owner_(std::move(owner)), time_(state.time) {}
  /// Owns both.
  Moment(State&& state, Fields&& fields) : time_(state.time) { keep(std::move(state), std::move(fields)); }
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

  [[nodiscard]] double time() const { return time_; }
  /// Takes over what it looks at.
  void keep(State&& state, Fields&& fields) {
    const std::lock_guard lock(mutex_);
    for (VesicleState& vesicle : state.vesicles) vesicle.recycled = {};
    own_state_ = std::move(state);
    own_fields_ = std::move(fields);
    state_ = &own_state_;
    fields_ = &own_fields_;
    owner_.reset();
  }
  /// @returns what `look(state, fields)` does; nobody takes anything over meanwhile
  template <typename Look>
  auto with(const Look& look) const {
    const std::lock_guard lock(mutex_);
    return look(*state_, *fields_);
  }

 private:
  const State* state_ = nullptr;
  const Fields* fields_ = nullptr;
  std::shared_ptr<const void> owner_;  ///< of what it looks at
  double time_;
  State own_state_;
  Fields own_fields_;
  mutable std::mutex mutex_;  // a step runs beside other threads of Python
};

}  // namespace vehd::python
