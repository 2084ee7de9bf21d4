#pragma once

#include <string>

namespace vehd {

/// Instruction set for which the loaded numerical libraries were compiled: "x86-64-v4" (AVX-512), "x86-64-v3" (AVX2
/// with FMA), "x86-64"; empty on other processors. An installed vehd contains one build for each, and the loader picks
/// the best one that the processor supports.
std::string instruction_set();

}  // namespace vehd
