# Writes the compressed manual pages of PROGRAM and of each of its COMMANDS to FOLDER.
function(write_page name title)
  set(page "${FOLDER}/${name}.1")
  string(REPLACE "-" " " words "${name}")
  string(REGEX REPLACE "^vehd" "${PROGRAM}" call "${words}")
  execute_process(COMMAND "${HELP2MAN}" --no-info --section 1 --source "vehd ${VERSION}" --manual "User Commands" --name
                          "${title}" --version-string "${VERSION}" --output "${page}" "${call}"
                  RESULT_VARIABLE status ERROR_VARIABLE message)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "help2man: ${message}")
  endif()
  # As gzip -9n: no name, no time, the same bytes every time.
  execute_process(COMMAND gzip -9nf "${page}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

write_page(vehd "simulate lipid vesicles in flow and electric field")
foreach(command IN LISTS COMMANDS)
  # The first line of a command's help says what it does.
  execute_process(COMMAND "${PROGRAM}" ${command} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]+" title "${help}")
  write_page(vehd-${command} "${title}")
endforeach()
