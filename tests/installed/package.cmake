# Makes the Debian package of a build, lets lintian read it and runs it from a folder of its own:
#   cmake -DBUILD=build -DFOLDER=work -P package.cmake
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/expect.cmake")

# Whoever runs the tests may have chosen libraries of the build.
unset(ENV{LD_LIBRARY_PATH})
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
get_filename_component(cmake_folder "${CMAKE_COMMAND}" DIRECTORY)
expect("" "${cmake_folder}/cpack" --config "${BUILD}/CPackConfig.cmake" -G DEB -B "${FOLDER}")
file(GLOB packages "${FOLDER}/*.deb")
list(LENGTH packages n_packages)
if(NOT n_packages EQUAL 1)
  message(FATAL_ERROR "${n_packages} packages in ${FOLDER}")
endif()
find_program(lintian lintian NO_CACHE)
if(lintian)
  # A user who is root runs the test in a container as well.
  expect("" "${lintian}" --fail-on error --allow-root "${packages}")
endif()

expect("" dpkg -x "${packages}" "${FOLDER}/root")
set(prefix "${FOLDER}/root/usr")
look_at_texts("${prefix}")
expect("x86-64" "${prefix}/bin/vehd" --version)
expect("" "${prefix}/bin/vehd" plan "${prefix}/share/vehd/scenes/figure2.toml")
file(GLOB levels "${prefix}/lib/vehd/glibc-hwcaps/*" "${prefix}/lib/*/vehd/glibc-hwcaps/*")
list(LENGTH levels n_levels)
if(NOT n_levels EQUAL 2)
  message(FATAL_ERROR "libraries for ${n_levels} levels beside x86-64, not 2")
endif()
