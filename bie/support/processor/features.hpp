#pragma once

#include <cstddef>

/// Instructions that a program was compiled for, and whether the processor has them. No template of the standard
/// library is instantiated here: the linker may take the function from an object that was compiled for another
/// processor.
namespace vehd::processor {

/// Instruction-set extensions that the other parts of the program may use; the last entry is null.
extern const char* const built_for[];

/// The names of the first list that are missing in the second, in their order. Lists end with a null.
/// @param missing  has room for as many entries as `needed`, the null included
/// @return number of missing names
std::size_t find_missing(const char* const* needed, const char* const* present, const char** missing);

}  // namespace vehd::processor
