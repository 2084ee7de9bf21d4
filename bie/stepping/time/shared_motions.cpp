#include "bie/stepping/time/shared_motions.hpp"

#include <string>
#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// A motion with the iterations that it took, or why there is none.
struct CountedMotion {
  Motion motion;
  int iterations = 0;
  std::string failure{};
};

template <MaybeConst<CountedMotion> Sent, typename Visit>
void visit_members(Sent& sent, Visit& visit) {
  visit(sent.motion, sent.iterations, sent.failure);
}

}  // namespace

std::vector<Motion> shared_motions(const Shares& shares, std::size_t n, int& iterations,
                                   const std::function<Motion(std::size_t)>& one) {
  const int before = std::exchange(iterations, 0);
  bool failed = false;
  std::vector<CountedMotion> all = shares.of_all(n, [&](std::size_t a) {
    CountedMotion result;
    // What comes after a failure is asked for by nobody.
    if (failed) return result;
    try {
      result.motion = one(a);
    } catch (const ConvergenceError& error) {
      failed = true;
      result.failure = error.what();
    }
    result.iterations = std::exchange(iterations, 0);
    return result;
  });
  iterations = before;
  std::vector<Motion> motions;
  for (CountedMotion& of_one : all) {
    iterations += of_one.iterations;
    if (!of_one.failure.empty()) throw ConvergenceError(of_one.failure);
    motions.push_back(std::move(of_one.motion));
  }
  return motions;
}

}  // namespace vehd
