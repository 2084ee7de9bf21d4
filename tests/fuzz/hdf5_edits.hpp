#pragma once

#include <string>
#include <string_view>

namespace fuzz {

struct EditedFile {
  bool is_checkpoint = false;
  std::string image;
};

/// A small valid run.h5 or checkpoint after the edits that the bytes encode.
EditedFile edited_file(std::string_view bytes);

}  // namespace fuzz
