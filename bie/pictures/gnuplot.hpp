#pragma once

#include <string>
#include <vector>

#include "bie/pictures/picture_format.hpp"

namespace vehd {

/// A file that a script of gnuplot's reads, by a name that vehd has chosen: letters, digits, '-' and '.'.
struct GnuplotFile {
  std::string name;
  std::string bytes;
};

/// Draws a picture. Gnuplot works in a folder of its own, where the files are, so no name of a file or directory that a
/// user has chosen stands in a script.
/// @param script   continues gnuplot_terminal()
/// @param picture  replaced when it is complete
/// @throws InputError if gnuplot is missing or reports an error; OutputError if the picture cannot be written
void draw_with_gnuplot(const std::string& script, const PictureFile& picture,
                       const std::vector<GnuplotFile>& files = {});

/// The lines of a gnuplot script that open a picture.
std::string gnuplot_terminal(PictureFormat format, const PictureSize& size);

/// Any text as a gnuplot string with just these bytes. All but letters and blanks are written as octal numbers:
/// nothing in the text can end the string or start a command.
std::string gnuplot_quoted(const std::string& text);

/// A name as enhanced text that prints it as it is: without this, an underscore would lower the next letter. Control
/// characters become blanks.
std::string gnuplot_literal(const std::string& text);

}  // namespace vehd
