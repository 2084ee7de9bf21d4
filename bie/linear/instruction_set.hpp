#pragma once

#include <string>

namespace vehd {

/// The instruction set for which the numerical libraries in use were compiled: "x86-64-v4" (AVX-512), "x86-64-v3"
/// (AVX2 with FMA), "x86-64"; empty on other processors. An installed vehd holds them for each, and the loader takes
/// the best one that the processor has.
std::string instruction_set();

}  // namespace vehd
