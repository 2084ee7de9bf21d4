# Lets lintian read a Debian package and runs it from a folder of its own:
#   cmake -DPACKAGE=vehd.deb -DFOLDER=work -P package.cmake
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/expect.cmake")

# Whoever runs this may have chosen libraries of a build.
unset(ENV{LD_LIBRARY_PATH})
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
find_program(lintian lintian NO_CACHE)
if(lintian)
  # A user who is root runs the test in a container as well.
  expect("" "${lintian}" --fail-on error --allow-root "${PACKAGE}")
endif()

expect("" dpkg -x "${PACKAGE}" "${FOLDER}/root")
set(prefix "${FOLDER}/root/usr")
look_at_texts("${prefix}")
expect("x86-64" "${prefix}/bin/vehd" --version)
expect("" "${prefix}/bin/vehd" plan "${prefix}/share/vehd/scenes/figure2.toml")
file(GLOB levels "${prefix}/lib/vehd/glibc-hwcaps/*" "${prefix}/lib/*/vehd/glibc-hwcaps/*")
list(LENGTH levels n_levels)
if(NOT n_levels EQUAL 2)
  message(FATAL_ERROR "libraries for ${n_levels} levels beside x86-64, not 2")
endif()
