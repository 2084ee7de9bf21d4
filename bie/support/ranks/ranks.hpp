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

/// The processes that compute one run together, called ranks; a single one unless there is a link. Copies share the
/// link.
///
/// All ranks take the same decisions from the same bits, so all make the same collective calls in the same order. If
/// one of them throws instead, the next collective call of the others throws the same exception: no rank waits for one
/// that has left. This holds within `collective`, the outermost of which encloses the whole run.
class Ranks {
 public:
  /// A single rank: nothing is sent.
  Ranks() = default;
  explicit Ranks(std::shared_ptr<RankLink> link) : link_(std::move(link)) {}

  [[nodiscard]] int rank() const { return link_ ? link_->rank() : 0; }
  [[nodiscard]] int size() const { return link_ ? link_->size() : 1; }
  [[nodiscard]] bool is_alone() const { return size() == 1; }
  /// The rank that writes files and prints.
  [[nodiscard]] bool is_first() const { return rank() == 0; }

  // Collective calls. Each throws the failure of any rank, see collective, or std::logic_error if ranks make different
  // calls: machines that round differently decide differently.

  /// Values of all ranks, in the order of ranks.
  [[nodiscard]] std::vector<std::string> gather(std::string own) const;
  /// Sends `to[r]` to rank r.
  /// @return the messages of all ranks to this one
  [[nodiscard]] std::vector<std::string> exchange(const std::vector<std::string>& to) const;
  /// True if `own` is true on any rank.
  [[nodiscard]] bool any(bool own) const;
  /// Barrier: returns when all ranks have called it.
  void meet() const;

  /// Runs `body` on all ranks. If some throw, all throw the exception of the lowest of these ranks, as a class of
  /// bie/support/errors.hpp, OutputError, std::logic_error or std::runtime_error.
  template <typename Body>
  std::invoke_result_t<const Body&> collective(const Body& body) const {
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
  /// Reports a failure to the other ranks, which are in a collective call or will come to one.
  [[noreturn]] void fail(const std::exception_ptr& exception) const;

  std::shared_ptr<RankLink> link_;
};

}  // namespace vehd
