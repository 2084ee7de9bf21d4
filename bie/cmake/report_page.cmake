# Writes OUTPUT, a C++ file with the page, style and scripts of FOLDER as strings (bie/pictures/report/page_data.hpp).
set(text "#include \"bie/pictures/report/page_data.hpp\"\n\nnamespace vehd {\nnamespace {\n")

# add_string(name files...): the files one after another.
macro(add_string name)
  string(APPEND text "\nconstexpr std::string_view ${name} =")
  foreach(file ${ARGN})
    file(READ "${FOLDER}/${file}" content)
    string(APPEND text "\n    R\"~~page~~(${content})~~page~~\"")
  endforeach()
  string(APPEND text ";\n")
endmacro()
add_string(page page.html)
add_string(style style.css)
# The last one starts what the others define.
add_string(script data.js sphere.js viewer.js plots.js page.js)

string(APPEND text "\n}  // namespace\n\nPageFiles page_files() { return {page, style, script}; }\n\n}  // namespace vehd\n")
file(WRITE "${OUTPUT}" "${text}")
