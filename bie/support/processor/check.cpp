#include <unistd.h>

#include <cstring>

#include "bie/support/processor/features.hpp"

// No template of the standard library is instantiated here: the linker may take the function from an object that was
// compiled for another processor.

#ifdef __x86_64__

namespace {

void say(const char* text) { [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text, std::strlen(text)); }

/// A line of features.def, and whether this processor has the extension.
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
#define FEATURE(name, macro) {name, __builtin_cpu_supports(name) != 0},
#include "bie/support/processor/features.def"
  };
  bool complete = true;
  const bool* needed = vehd::processor::built_for;
  for (const Feature& feature : features) {
    if (!*needed++ || feature.present) continue;
    if (complete) {
      say(argc > 0 ? file_name(argv[0]) : "vehd");
      say(": this program was built for a processor with ");
    } else {
      say(", ");
    }
    say(feature.name);
    complete = false;
  }
  if (complete) return;
  say(", which this one lacks; build it on this machine, or for others as well (docs/building.md)\n");
  ::_exit(1);
}

/// Runs before all initialisers, even those of shared libraries: the loader binds these to functions of this program if
/// both have instantiated the same template.
__attribute__((section(".preinit_array"), used)) void (*first_of_all)(int, char**,
                                                                      char**) = refuse_a_processor_that_lacks_something;

}  // namespace

#endif
