#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Calls body(i) for i = 0 … count − 1, on all threads if `worthwhile`, in an order that no result may depend on. Even
/// a team of one makes system calls, so loops that are not worth it stay out of OpenMP altogether.
template <typename Body>
void for_each_index(Index count, bool worthwhile, const Body& body) {
  if (!worthwhile) {
    for (Index i = 0; i < count; ++i) body(i);
    return;
  }
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < count; ++i) body(i);
}

}  // namespace vehd
