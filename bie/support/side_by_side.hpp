#pragma once

#include <omp.h>

#include <algorithm>
#include <deque>

#include "bie/support/instruments.hpp"
#include "bie/support/parallel.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Calls body(i, instruments) for a few tasks i = 0 … count − 1 of about equal cost. If `worthwhile`, as many run
/// concurrently as there are threads, each on one thread; a single task that is left over uses all threads. No result
/// may depend on the order. If some throw, the exception of the lowest i is rethrown after all have ended, whether they
/// run concurrently or not.
template <typename Body>
void for_each_side_by_side(Index count, bool worthwhile, Instruments& instruments, const Body& body) {
  Exceptions exceptions(count);
  const auto run = [&](Index i, Instruments& of_one) { exceptions.keep(i, [&] { body(i, of_one); }); };
  const int at_once = worthwhile && omp_in_parallel() == 0 ? omp_get_max_threads() : 1;
  int n_now = 0;
  for (Index first = 0; first < count; first += n_now) {
    n_now = static_cast<int>(std::min<Index>(count - first, at_once));
    if (n_now == 1) {
      run(first, instruments);
      continue;
    }
    count_side_by_side(n_now, instruments, [&](std::deque<Instruments>& of_each) {
#pragma omp parallel for schedule(static, 1) num_threads(n_now)
      for (int i = 0; i < n_now; ++i) run(first + i, of_each[static_cast<std::size_t>(i)]);
    });
  }
  exceptions.rethrow_first();
}

}  // namespace vehd
