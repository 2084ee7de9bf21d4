#include "bie/support/processor/features.hpp"

// A macro that is not defined expands to its own name.
#define TEXT_OF_EXPANDED(text) #text
#define TEXT_OF(macro) TEXT_OF_EXPANDED(macro)
#define FEATURE(name, macro) TEXT_OF(macro)[0] == '1',

// Compiled with the flags of the whole program, but contains no instructions.
constinit const bool vehd::processor::built_for[] = {
#include "bie/support/processor/features.def"
};
