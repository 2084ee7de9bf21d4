// The loop around a target is libFuzzer's; VEHD_FUZZ_TARGET is one of the functions in tests/fuzz/targets.hpp.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::VEHD_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
