#pragma once

namespace vehd {

/// Floating-point operations per second that n_threads threads reach together in products of matrices that fit into
/// their caches: the peak rate of the machine in double precision. Takes a quarter of a second.
double measured_peak(int n_threads);

}  // namespace vehd
