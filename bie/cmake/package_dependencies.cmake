# cpack reads this file after its configuration.

# Sets CPACK_DEBIAN_PACKAGE_DEPENDS to the Debian packages of the libraries that the programs and libraries LINKED need, except
# their own ones in the folder LIBRARIES. dpkg-shlibdeps runs in FOLDER, because it expects a source package.
macro(find_package_dependencies)
  cmake_parse_arguments(dependencies "" "FOLDER;LIBRARIES" "LINKED" ${ARGN})
  find_program(dependencies_program dpkg-shlibdeps REQUIRED NO_CACHE)
  file(WRITE "${dependencies_FOLDER}/debian/control" "")
  list(TRANSFORM dependencies_LINKED PREPEND "-e")
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C "${dependencies_program}" "-l${dependencies_LIBRARIES}"
                          --ignore-missing-info -O ${dependencies_LINKED}
                  WORKING_DIRECTORY "${dependencies_FOLDER}" OUTPUT_VARIABLE dependencies_found
                  ERROR_VARIABLE dependencies_problem RESULT_VARIABLE dependencies_status)
  if(NOT dependencies_status EQUAL 0 OR NOT dependencies_found MATCHES "Depends=([^\n]+)")
    message(FATAL_ERROR "dpkg-shlibdeps (${dependencies_status}): ${dependencies_problem}")
  endif()
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
endmacro()
