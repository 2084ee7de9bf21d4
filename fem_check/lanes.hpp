#pragma once

/// Vector registers for deal.II's matrix-free loops. Include this before any other header of deal.II.

#include <deal.II/base/config.h>
#include <deal.II/base/numbers.h>

// Distributions compile deal.II for every x86-64 and configure it for scalar numbers; that remains the default of
// VectorizedArray (numbers.h), as in the compiled library. The wider types are header-only: they depend on the
// instruction set for which vehd is compiled, and loops that use them are compiled here.
#pragma push_macro("DEAL_II_VECTORIZATION_WIDTH_IN_BITS")
#undef DEAL_II_VECTORIZATION_WIDTH_IN_BITS
#if defined(__AVX512F__)
#define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 512
#elif defined(__AVX__)
#define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 256
#elif defined(__SSE2__)
#define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 128
#else
#define DEAL_II_VECTORIZATION_WIDTH_IN_BITS 0
#endif
#include <deal.II/base/vectorization.h>

namespace vehd::fem_check {

/// One number for each of several cells, which are processed at once.
#if DEAL_II_VECTORIZATION_WIDTH_IN_BITS > 0
using Lanes = dealii::VectorizedArray<double, DEAL_II_VECTORIZATION_WIDTH_IN_BITS / 64>;
#else
using Lanes = dealii::VectorizedArray<double, 1>;
#endif

}  // namespace vehd::fem_check

#pragma pop_macro("DEAL_II_VECTORIZATION_WIDTH_IN_BITS")
