# Writes the source OUTPUT with the texts of SCENES, so that the program has them wherever it is.
set(source "// Made from docs/scenes.\n#include \"bie/scene/shipped_scenes.hpp\"\n\nnamespace vehd {\n
const std::vector<ShippedScene>& shipped_scenes() {\n  static const std::vector<ShippedScene> scenes = {\n")
foreach(scene IN LISTS SCENES)
  get_filename_component(name "${scene}" NAME_WE)
  file(READ "${scene}" text)
  string(APPEND source "      {\"${name}\", R\"scene(${text})scene\"},\n")
endforeach()
string(APPEND source "  };\n  return scenes;\n}\n\n}  // namespace vehd\n")
file(WRITE "${OUTPUT}" "${source}")
