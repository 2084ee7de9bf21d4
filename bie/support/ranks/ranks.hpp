#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "bie/support/ranks/rank_link.hpp"

namespace vehd {

/// Marks an exception that all ranks throw.
class Agreed {};

/// Processes that compute one run together, its ranks; one alone unless there is a link. A value: copies talk over the
/// same link.
///
/// All ranks take the same decisions from the same bits, so all make the same collective calls in the same order. Where
/// one of them throws instead, the next collective call of the others throws the same: nobody waits for a rank that
/// has left. That holds within `together`, the outermost of which is around the whole run.
class Ranks {
 public:
  /// Alone: nothing is sent anywhere.
  Ranks() = default;
  explicit Ranks(std::shared_ptr<RankLink> link) : link_(std::move(link)) {}

  [[nodiscard]] int rank() const { return link_ ? link_->rank() : 0; }
  [[nodiscard]] int size() const { return link_ ? link_->size() : 1; }
  [[nodiscard]] bool is_alone() const { return size() == 1; }
  /// The rank that writes files and prints.
  [[nodiscard]] bool is_first() const { return rank() == 0; }

  // Collective calls. Each throws what any rank has failed with, see together, or std::logic_error where ranks do
  // different things: machines that round differently decide differently.

  /// Values of all ranks, in their order.
  [[nodiscard]] std::vector<std::string> gather(std::string own) const;
  /// `to[r]` goes to rank r.
  /// @return the messages of all ranks to this one
  [[nodiscard]] std::vector<std::string> exchange(const std::vector<std::string>& to) const;
  /// Whether it holds on any rank.
  [[nodiscard]] bool any(bool own) const;
  /// Returns when all ranks have come here.
  void meet() const;

  /// Runs `body` on all ranks. If one throws, all throw the same: of several the exception of the lowest rank. Its
  /// class is that of bie/support/errors.hpp or output_error.hpp, or std::runtime_error.
  template <typename Body>
  std::invoke_result_t<const Body&> together(const Body& body) const {
    if (is_alone()) return body();
    if constexpr (std::is_void_v<std::invoke_result_t<const Body&>>) {
      guarded(body);
      meet();
    } else {
      auto result = guarded(body);
      meet();
      return result;
    }
  }

 private:
  template <typename Body>
  std::invoke_result_t<const Body&> guarded(const Body& body) const {
    try {
      return body();
    } catch (const Agreed&) {
      throw;
    } catch (...) {
      fail(std::current_exception());
    }
  }
  [[nodiscard]] std::vector<std::string> gather_as(char call, const std::string& own) const;
  /// Tells the others, who are in some collective call or come to one.
  [[noreturn]] void fail(const std::exception_ptr& exception) const;

  std::shared_ptr<RankLink> link_;
};

}  // namespace vehd
