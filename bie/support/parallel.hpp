#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <exception>
#include <iterator>
#include <vector>

#include "bie/support/instruments.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Calls body(i) for i = 0 … count − 1, on all threads if `worthwhile`; no result may depend on the order. Even a team
/// of one thread makes system calls, so other loops bypass OpenMP.
template <typename Body>
void for_each_index(Index count, bool worthwhile, const Body& body) {
  if (!worthwhile) {
    for (Index i = 0; i < count; ++i) body(i);
    return;
  }
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < count; ++i) body(i);
}

/// Exceptions thrown by calls on several threads.
class Exceptions {
 public:
  explicit Exceptions(Index count) : of_each_(static_cast<std::size_t>(count)) {}
  /// Calls body and keeps its exception as number i.
  template <typename Body>
  void keep(Index i, const Body& body) {
    try {
      body();
    } catch (...) {
      of_each_[static_cast<std::size_t>(i)] = std::current_exception();
    }
  }
  /// Rethrows the first exception, if there is one.
  void rethrow_first() const {
    for (const std::exception_ptr& exception : of_each_) {
      if (exception) std::rethrow_exception(exception);
    }
  }

 private:
  std::vector<std::exception_ptr> of_each_;
};

/// Calls body(of_each) with separate instruments for `count` tasks that body runs concurrently, and adds their counts.
template <typename Body>
void count_side_by_side(Index count, Instruments& instruments, const Body& body) {
  std::deque<Instruments> of_each(static_cast<std::size_t>(count));
  const auto start = std::chrono::steady_clock::now();
  body(of_each);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  instruments.take_side_by_side(of_each, elapsed.count());
}

/// Are there enough members to distribute them over threads? With fewer, the work on each one is parallel instead.
inline bool are_many(Index count) {
  constexpr Index kFew = 8;
  return count > kFew;
}

/// Calls body(i) for the members i = 0 … count − 1 of a group, on all threads if there are many; no result may depend
/// on the order. In parallel, the exception of the lowest member is rethrown after all have ended.
template <typename Body>
void for_each_member(Index count, const Body& body) {
  if (!are_many(count)) {
    for (Index i = 0; i < count; ++i) body(i);
    return;
  }
  Exceptions exceptions(count);
#pragma omp parallel for schedule(dynamic, 1)
  for (Index i = 0; i < count; ++i) exceptions.keep(i, [&] { body(i); });
  exceptions.rethrow_first();
}

/// Parallel loop over given members: body(member).
template <typename Body>
void for_each_member(const std::vector<std::size_t>& members, const Body& body) {
  for_each_member(std::ssize(members), [&](Index i) { body(members[static_cast<std::size_t>(i)]); });
}

/// Parallel loop whose members count their work: body(i, instruments).
template <typename Body>
void for_each_member(Index count, Instruments& instruments, const Body& body) {
  if (!are_many(count)) {
    for (Index i = 0; i < count; ++i) body(i, instruments);
    return;
  }
  count_side_by_side(count, instruments, [&](std::deque<Instruments>& of_each) {
    for_each_member(count, [&](Index i) { body(i, of_each[static_cast<std::size_t>(i)]); });
  });
}

/// Parallel loop over given members that count their work: body(member, instruments).
template <typename Body>
void for_each_member(const std::vector<std::size_t>& members, Instruments& instruments, const Body& body) {
  for_each_member(std::ssize(members), instruments,
                  [&](Index i, Instruments& of_one) { body(members[static_cast<std::size_t>(i)], of_one); });
}

}  // namespace vehd
