# Installs a build, checks the installed files and builds a program that uses it; PYTHON runs the Python module, if
# there is one:
#   cmake -DBUILD=build -DSOURCE=source -DFOLDER=work -DPYTHON=python3 -P install.cmake
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/expect.cmake")

# The user may have set a path to libraries of the build.
unset(ENV{LD_LIBRARY_PATH})
set(prefix "${FOLDER}/prefix")
file(REMOVE_RECURSE "${FOLDER}")
expect("" "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}")

expect("^vehd [0-9]+\\.[0-9]+\\.[0-9]+\n" "${prefix}/bin/vehd" --version)
look_at_texts("${prefix}")
expect("stokes_single" "${prefix}/bin/vehd" plan "${prefix}/share/vehd/scenes/figure5_no_field.toml")

# The module must be loaded from the place of installation, not from the build.
file(GLOB module "${prefix}/lib/python3/dist-packages/vehd/_core*")
if(PYTHON AND module)
  expect("Example 1[^\n]*\ndegree 6: error of q" "${CMAKE_COMMAND}" -E env
         "PYTHONPATH=${prefix}/lib/python3/dist-packages" "${PYTHON}" -m vehd --degree 6)
elseif(PYTHON)
  message(FATAL_ERROR "the module of Python is not installed")
endif()

set(consumer "${FOLDER}/consumer")
expect("" "${CMAKE_COMMAND}" -S "${SOURCE}/tests/installed/consumer" -B "${consumer}" "-DCMAKE_PREFIX_PATH=${prefix}"
       -DCMAKE_BUILD_TYPE=Release)
expect("" "${CMAKE_COMMAND}" --build "${consumer}")
expect("relative errors" "${consumer}/prolate")
expect("extent along z" "${consumer}/steps" "${prefix}/share/vehd/scenes/figure5_no_field.toml")
