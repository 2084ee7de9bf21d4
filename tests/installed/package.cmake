# Makes a Debian package of a build, in BUILD/package, checks it with lintian and runs its programs from a separate
# folder. LEVELS is the number of instruction sets for which it has numerical libraries, beside that of the rest; PYTHON
# runs the Python module, if there is one:
#   cmake -DBUILD=build -DLEVELS=2 -DFOLDER=work -DPYTHON=python3 -P package.cmake
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/expect.cmake")

# The user may have set a path to libraries of a build.
unset(ENV{LD_LIBRARY_PATH})
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
find_program(shlibdeps dpkg-shlibdeps NO_CACHE)
if(NOT shlibdeps)
  message("Not tried: dpkg-shlibdeps is not installed")
  return()
endif()
find_program(cpack cpack REQUIRED NO_CACHE)
file(REMOVE_RECURSE "${BUILD}/package")
expect("" "${cpack}" --config "${BUILD}/CPackConfig.cmake" -G DEB -B "${BUILD}/package")
file(GLOB PACKAGE "${BUILD}/package/*.deb")
find_program(lintian lintian NO_CACHE)
if(lintian)
  # --allow-root: in a container the test runs as root.
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

# The folder in which Debian's python3 looks for modules, with the dependencies of the module.
if(PYTHON)
  expect("Example 1[^\n]*\ndegree 6: error of q" "${CMAKE_COMMAND}" -E env
         "PYTHONPATH=${prefix}/lib/python3/dist-packages" "${PYTHON}" -m vehd --degree 6)
  expect("python3-numpy" dpkg-deb --field "${PACKAGE}" Recommends)
  expect("^python3-vehd" dpkg-deb --field "${PACKAGE}" Provides)
endif()
