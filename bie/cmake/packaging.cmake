# cpack -G DEB: one package with everything that is installed. Built with VEHD_ARCHITECTURE=levels it runs on every x86-64.
set(CPACK_PACKAGE_NAME vehd)
set(CPACK_PACKAGE_VENDOR vehd)
set(CPACK_PACKAGE_CONTACT "vehd developers <vehd@packages.debian.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulator of lipid vesicles in flow and electric field")
set(CPACK_PACKAGE_DESCRIPTION
    "vehd simulates lipid vesicles, which are membranes that bend, keep their local
area and charge like leaky capacitors, in viscous flow and electric field. It
solves boundary integral equations by spherical harmonics and plots the
results. Scenes are written in TOML, dimensionless or in SI units.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The packages of the libraries that these link. With CPACK_DEBIAN_PACKAGE_SHLIBDEPS cpack would look for them itself, and
# start two processes for each file of the package to find out which of them are programs.
set(linked)
foreach(target IN ITEMS vehd vehd_fem_program vehd_python LISTS modules level_modules)
  if(TARGET ${target})
    get_target_property(type ${target} TYPE)
    if(type MATCHES "^(EXECUTABLE|SHARED_LIBRARY|MODULE_LIBRARY)$")
      list(APPEND linked "$<TARGET_FILE:${target}>")
    endif()
  endif()
endforeach()
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/package_dependencies.cmake CONTENT "\
include(\"${CMAKE_CURRENT_LIST_DIR}/package_dependencies.cmake\")
if(CPACK_GENERATOR STREQUAL \"DEB\")
  find_package_dependencies(FOLDER \"${PROJECT_BINARY_DIR}/package_dependencies\" LIBRARIES \"${CMAKE_BINARY_DIR}/lib\"
                            LINKED \"${linked}\")
endif()
")
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/package_dependencies.cmake)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, python3-h5py, python3-matplotlib, libeigen3-dev, libfmt-dev, paraview")
if(has_python)
  # The compiled part belongs to one version of Python.
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), \
python3 (<< ${Python3_VERSION_MAJOR}.${next_minor}), python3-numpy")
  string(APPEND CPACK_DEBIAN_PACKAGE_SUGGESTS ", python3-scipy, python3-pandas, jupyter-notebook")
  set(CPACK_DEBIAN_PACKAGE_PROVIDES "python3-vehd (= ${PROJECT_VERSION})")
endif()
# What Debian asks of the files and folders of a package.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/debian/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
set(changelog ${PROJECT_BINARY_DIR}/changelog.gz)
add_custom_command(OUTPUT ${changelog}
                   COMMAND gzip -9nc ${CMAKE_CURRENT_LIST_DIR}/debian/changelog > ${changelog}
                   DEPENDS ${CMAKE_CURRENT_LIST_DIR}/debian/changelog VERBATIM)
add_custom_target(vehd_changelog ALL DEPENDS ${changelog})
install(FILES ${changelog} DESTINATION ${CMAKE_INSTALL_DOCDIR})
include(CPack)
