#pragma once

#include <cstddef>

/// Instructions that a program was compiled for, and whether the processor has them. Nothing of the standard
/// library is instantiated here: the linker may take such a function from a part that was compiled for another
/// processor.
namespace vehd::processor {

/// Extensions of the instruction set that the other parts of the program may use; the last entry is null.
extern const char* const built_for[];

/// The names of the first list that the second one lacks, in their order. Lists end with a null.
/// @param missing  has room for as many entries as `needed`, the null included
/// @return how many
std::size_t find_missing(const char* const* needed, const char* const* present, const char** missing);

}  // namespace vehd::processor
