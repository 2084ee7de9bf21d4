# Makes a Debian package of a build, in BUILD/package, lets lintian read it and runs what is in it from a folder of its own.
# LEVELS is how many instruction sets its numerical libraries are for beside that of the rest; PYTHON runs the module of
# Python, where there is one:
#   cmake -DBUILD=build -DLEVELS=2 -DFOLDER=work -DPYTHON=python3 -P package.cmake
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/expect.cmake")

# Whoever runs this may have chosen libraries of a build.
unset(ENV{LD_LIBRARY_PATH})
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
find_program(shlibdeps dpkg-shlibdeps NO_CACHE)
if(NOT shlibdeps)
  message("Not tried: dpkg-shlibdeps is not there")
  return()
endif()
find_program(cpack cpack REQUIRED NO_CACHE)
file(REMOVE_RECURSE "${BUILD}/package")
expect("" "${cpack}" --config "${BUILD}/CPackConfig.cmake" -G DEB -B "${BUILD}/package")
file(GLOB PACKAGE "${BUILD}/package/*.deb")
find_program(lintian lintian NO_CACHE)
if(lintian)
  # A user who is root runs the test in a container as well.
  expect("" "${lintian}" --fail-on error --allow-root "${PACKAGE}")
endif()

expect("" dpkg -x "${PACKAGE}" "${FOLDER}/root")
set(prefix "${FOLDER}/root/usr")
look_at_texts("${prefix}")
expect("^vehd [0-9]+\\.[0-9]+\\.[0-9]+\n" "${prefix}/bin/vehd" --version)
expect("" "${prefix}/bin/vehd" plan "${prefix}/share/vehd/scenes/figure2.toml")
file(GLOB levels "${prefix}/lib/vehd/glibc-hwcaps/*" "${prefix}/lib/*/vehd/glibc-hwcaps/*")
list(LENGTH levels n_levels)
if(NOT n_levels EQUAL LEVELS)
  message(FATAL_ERROR "libraries for ${n_levels} further instruction sets, not ${LEVELS}")
endif()
if(LEVELS GREATER 0)
  expect("x86-64" "${prefix}/bin/vehd" --version)
endif()

# Where Debian's python3 looks, and with what it needs.
if(PYTHON)
  expect("Example 1[^\n]*\ndegree 6: error of q" "${CMAKE_COMMAND}" -E env
         "PYTHONPATH=${prefix}/lib/python3/dist-packages" "${PYTHON}" -m vehd --degree 6)
  expect("python3-numpy" dpkg-deb --field "${PACKAGE}" Recommends)
  expect("^python3-vehd" dpkg-deb --field "${PACKAGE}" Provides)
endif()
