# cmake --install installs the program, libraries and headers for find_package(vehd), manual pages, shell completion, scenes
# and pages. cpack -G DEB makes a Debian package of them.
get_property(modules GLOBAL PROPERTY vehd_modules)
get_property(level_modules GLOBAL PROPERTY vehd_level_modules)

install(TARGETS vehd RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET vehd_fem_program)
  install(TARGETS vehd_fem_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(TARGETS ${modules} vehd_flags EXPORT vehd
        LIBRARY DESTINATION ${library_folder}
        ARCHIVE DESTINATION ${library_folder})
foreach(target IN LISTS level_modules)
  get_target_property(level ${target} VEHD_LEVEL)
  install(TARGETS ${target} LIBRARY DESTINATION ${library_folder}/glibc-hwcaps/${level} NAMELINK_SKIP)
endforeach()

include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/vehd)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/vehd-config.cmake.in ${PROJECT_BINARY_DIR}/vehd-config.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vehd-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vehd-config.cmake ${PROJECT_BINARY_DIR}/vehd-config-version.cmake
        DESTINATION ${config_folder})
install(EXPORT vehd NAMESPACE vehd:: FILE vehd-targets.cmake DESTINATION ${config_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/bie DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vehd FILES_MATCHING PATTERN "*.hpp"
        PATTERN app EXCLUDE PATTERN python EXCLUDE PATTERN processor EXCLUDE PATTERN cmake EXCLUDE)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/vehd)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN scenes EXCLUDE
        PATTERN site EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CITATION.cff ${PROJECT_SOURCE_DIR}/CHANGELOG.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The program prints its own completion and manual pages, so it must run on the machine that builds it.
set(texts ${PROJECT_BINARY_DIR}/texts)
set(completions ${texts}/vehd ${texts}/_vehd)
add_custom_command(OUTPUT ${completions}
                   COMMAND ${CMAKE_COMMAND} -E make_directory ${texts}
                   COMMAND $<TARGET_FILE:vehd> completion bash > ${texts}/vehd
                   COMMAND $<TARGET_FILE:vehd> completion zsh > ${texts}/_vehd
                   DEPENDS vehd VERBATIM)
set(pages)
find_program(HELP2MAN help2man)
mark_as_advanced(HELP2MAN)
if(HELP2MAN)
  # The program and each command have a manual page, as with git.
  set(commands run sweep fit synthesise plan plot report check mesh verify bench examples)
  set(pages ${texts}/vehd.1.gz)
  foreach(command IN LISTS commands)
    list(APPEND pages ${texts}/vehd-${command}.1.gz)
  endforeach()
  add_custom_command(OUTPUT ${pages}
                     COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:vehd> -DHELP2MAN=${HELP2MAN} -DFOLDER=${texts}
                             "-DCOMMANDS=${commands}" -DVERSION=${PROJECT_VERSION} -P
                             ${CMAKE_CURRENT_LIST_DIR}/man_pages.cmake
                     DEPENDS vehd ${CMAKE_CURRENT_LIST_DIR}/man_pages.cmake VERBATIM)
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
else()
  message(STATUS "No man pages: help2man is not installed")
endif()
add_custom_target(vehd_texts ALL DEPENDS ${completions} ${pages})
install(FILES ${texts}/vehd DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${texts}/_vehd DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)

include(${CMAKE_CURRENT_LIST_DIR}/packaging.cmake)
