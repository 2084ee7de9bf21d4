#include <unistd.h>

#include <cstring>
#include <iterator>

#include "bie/support/processor/features.hpp"

#ifdef __x86_64__

namespace {

using vehd::processor::built_for;

void say(const char* text) { [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text, std::strlen(text)); }

/// An extension that `built_for` may name, and whether this processor has it.
struct Feature {
  const char* name;
  bool present;
};

/// Last component of a path: "vehd" of "build/vehd".
const char* file_name(const char* path) {
  const char* slash = std::strrchr(path, '/');
  return slash == nullptr ? path : slash + 1;
}

void refuse_a_processor_that_lacks_something(int argc, char** argv, char** /*environment*/) {
  __builtin_cpu_init();
  const Feature features[] = {
      {"sse3", __builtin_cpu_supports("sse3") != 0},
      {"ssse3", __builtin_cpu_supports("ssse3") != 0},
      {"sse4.1", __builtin_cpu_supports("sse4.1") != 0},
      {"sse4.2", __builtin_cpu_supports("sse4.2") != 0},
      {"popcnt", __builtin_cpu_supports("popcnt") != 0},
      {"avx", __builtin_cpu_supports("avx") != 0},
      {"avx2", __builtin_cpu_supports("avx2") != 0},
      {"fma", __builtin_cpu_supports("fma") != 0},
      {"fma4", __builtin_cpu_supports("fma4") != 0},
      {"xop", __builtin_cpu_supports("xop") != 0},
      {"bmi", __builtin_cpu_supports("bmi") != 0},
      {"bmi2", __builtin_cpu_supports("bmi2") != 0},
      {"aes", __builtin_cpu_supports("aes") != 0},
      {"pclmul", __builtin_cpu_supports("pclmul") != 0},
      {"gfni", __builtin_cpu_supports("gfni") != 0},
      {"vpclmulqdq", __builtin_cpu_supports("vpclmulqdq") != 0},
      {"avx512f", __builtin_cpu_supports("avx512f") != 0},
      {"avx512cd", __builtin_cpu_supports("avx512cd") != 0},
      {"avx512vl", __builtin_cpu_supports("avx512vl") != 0},
      {"avx512bw", __builtin_cpu_supports("avx512bw") != 0},
      {"avx512dq", __builtin_cpu_supports("avx512dq") != 0},
      {"avx512ifma", __builtin_cpu_supports("avx512ifma") != 0},
      {"avx512vbmi", __builtin_cpu_supports("avx512vbmi") != 0},
      {"avx512vbmi2", __builtin_cpu_supports("avx512vbmi2") != 0},
      {"avx512vnni", __builtin_cpu_supports("avx512vnni") != 0},
      {"avx512bitalg", __builtin_cpu_supports("avx512bitalg") != 0},
      {"avx512vpopcntdq", __builtin_cpu_supports("avx512vpopcntdq") != 0},
      {"avx512bf16", __builtin_cpu_supports("avx512bf16") != 0},
  };
  const char* present[std::size(features) + 1] = {};
  std::size_t count = 0;
  for (const Feature& feature : features) {
    if (feature.present) present[count++] = feature.name;
  }
  const char* missing[std::size(features) + 1] = {};
  if (vehd::processor::find_missing(built_for, present, missing) == 0) return;
  say(argc > 0 ? file_name(argv[0]) : "vehd");
  say(": this program was built for a processor with ");
  for (const char** name = missing; *name != nullptr; ++name) {
    if (name != missing) say(", ");
    say(*name);
  }
  say(", which this one lacks; build it on this machine, or for others as well (docs/building.md)\n");
  ::_exit(1);
}

/// Runs before all initialisers, even those of shared libraries: the loader binds these to functions of this program if
/// both have instantiated the same template.
__attribute__((section(".preinit_array"), used)) void (*first_of_all)(int, char**,
                                                                      char**) = refuse_a_processor_that_lacks_something;

}  // namespace

#endif
