#pragma once

#include <string>
#include <string_view>

namespace fuzz {

struct EditedFile {
  bool is_checkpoint = false;
  std::string image;
};

/// A small good run.h5 or checkpoint after the edits that the bytes stand for.
EditedFile edited_file(std::string_view bytes);

}  // namespace fuzz
