# Goes from a fresh Debian 12 or 13 with git, cmake and g++ to a result, called from any folder. Each step installs the Debian
# packages that it needs and that are missing:
#   cmake -P bie/setup.cmake               builds vehd and simulates Example 2 of the paper
#   cmake -DSTEP=test -P bie/setup.cmake   builds vehd, the finite-element check and the module of Python, and runs the tests
#   cmake -DSTEP=build -P bie/setup.cmake  builds vehd
#   cmake -DSTEP=check -P bie/setup.cmake  builds the finite-element check and compares the two methods on the first shape of
#                                          Example 2
#   cmake -DSTEP=python -P bie/setup.cmake   builds the module of Python in build/python, runs Example 1 of the paper with it
#   cmake -DSTEP=callgrind -P bie/setup.cmake  counts the instructions of a run without electricity: none may be in electric
#                                              code, and next to none in bookkeeping
#   cmake -DSTEP=faults -P bie/setup.cmake    kills a run 200 times, damages runs at 1000 places and makes files and the disk
#                                             fail in every other way
#   cmake -DSTEP=slurm -P bie/setup.cmake     starts a Slurm on this machine alone and tests sweeps and a run with it; as root
#   cmake -DSTEP=sanitize -P bie/setup.cmake  runs all tests with clang's address and undefined-behaviour sanitizers
#   cmake -DSTEP=fuzz -P bie/setup.cmake      fuzzes each reader of files for 10 minutes with clang; -DSECONDS=60 before -P
#                                             changes the time
#   cmake -DSTEP=docs -P bie/setup.cmake   renews every picture of the pages, and every table that the program measures itself
#   cmake -DSTEP=site -P bie/setup.cmake   makes one site of the pages, the Python API and the interfaces of all headers, in
#                                          build/site; executes the notebooks if build has the module of Python; compiles
#                                          nothing
#   cmake -DSTEP=package -P bie/setup.cmake   builds a Debian package for every x86-64 in build-levels, checks it with lintian
#                                             and tests it
#   cmake -DSTEP=archive -P bie/setup.cmake   builds archives for every x86-64 that need no package manager, one with the
#                                             finite elements and one without, in build-archive, and tests them
# Options before -P, for every step:
#   -DINSTALL=OFF                   installs nothing: names missing packages, and continues if the step can do without them
#   -DVEHD_FEM_CHECK=OFF            test and archive omit the finite-element check and the packages that it needs. With ON,
#                                   build and docs include it and install its packages; without this option they include it
#                                   if deal.II and gmsh are installed
#   -DVEHD_PYTHON=OFF               test, package and archive omit the module of Python and the packages that it needs. With
#                                   ON, build and docs include it and install its packages; without this option they include
#                                   it if pybind11 and numpy are installed
#   -DVEHD_MPI=ON                   builds a vehd that runs on several processes
#   -DVEHD_ARCHITECTURE=x86-64-v3   builds for this instruction set, in build-x86-64-v3, instead of for this machine. levels
#                                   builds for every x86-64, with the numerical libraries for its newer levels as well
#   -DVEHD_TEST_LEVEL=x86-64-v3     build compiles the numerical libraries for this instruction set as well, and test repeats
#                                   on them the tests that rounding could change
#   -DEXTENDED=ON                   test also runs the tests labelled extended (docs/building.md)
#   -DOTHER_DEBIAN=ON               test continues in a bare system of the other Debian release, 13 or 12
#   -DTESTS=REGEX                   test runs only the tests whose names match
#   -DCMAKE_COMPILE_WARNING_AS_ERROR=ON   a warning of the compiler ends the build
cmake_minimum_required(VERSION 3.25)

get_filename_component(source "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)
set(steps run test build check python package callgrind faults slurm sanitize fuzz docs site archive)
if(NOT DEFINED STEP)
  set(STEP run)
endif()
if(NOT STEP IN_LIST steps)
  list(JOIN steps ", " accepted)
  message(FATAL_ERROR "STEP is \"${STEP}\"; accepted: ${accepted}")
endif()
if(NOT DEFINED INSTALL)
  set(INSTALL ON)
endif()
if(NOT DEFINED SECONDS)
  set(SECONDS 600)
endif()
if(NOT DEFINED TESTS)
  set(TESTS .)
endif()

if(NOT DEFINED VEHD_FEM_CHECK)
  set(VEHD_FEM_CHECK OFF)
  if(STEP MATCHES "^(test|archive)$")
    set(VEHD_FEM_CHECK ON)
  elseif(STEP MATCHES "^(build|docs)$")
    set(VEHD_FEM_CHECK AUTO)
  endif()
endif()
if(STEP STREQUAL "check")
  set(VEHD_FEM_CHECK ON)
endif()

if(STEP MATCHES "^(test|python|package|archive)$" AND NOT DEFINED VEHD_PYTHON)
  set(VEHD_PYTHON ON)
elseif(NOT DEFINED VEHD_PYTHON)
  set(VEHD_PYTHON OFF)
  if(STEP MATCHES "^(build|docs)$")
    set(VEHD_PYTHON AUTO)
  endif()
endif()

# Each instruction set has its own build folder, so that switching between them recompiles nothing.
set(build "${source}/build")
if(STEP MATCHES "^(package|archive)$")
  set(VEHD_ARCHITECTURE levels)
elseif(NOT DEFINED VEHD_ARCHITECTURE)
  set(VEHD_ARCHITECTURE native)
endif()
if(NOT VEHD_ARCHITECTURE STREQUAL "native")
  set(build "${source}/build-${VEHD_ARCHITECTURE}")
endif()
if(STEP STREQUAL "archive")
  # The package is by default built without finite elements, so the two steps do not share a folder.
  set(build "${source}/build-archive")
elseif(STEP STREQUAL "callgrind")
  # Valgrind does not know the instructions of every new processor, so the compiler uses its default set.
  set(VEHD_ARCHITECTURE "")
  set(build "${source}/build-callgrind")
elseif(STEP MATCHES "^(sanitize|fuzz)$")
  set(build "${source}/build-sanitize")
endif()

function(run_or_stop)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY "${source}" RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${status}): ${command}")
  endif()
endfunction()

# Debian packages of the programs, fonts and Python modules that the step needs and that are missing. The configuration
# looks for the libraries (bie/cmake/dependencies.cmake).
set(missing)
macro(need_program package)
  find_program(found_${package} NAMES ${ARGN} NO_CACHE)
  if(NOT found_${package})
    list(APPEND missing ${package})
  endif()
endmacro()
macro(need_python_module package module)
  execute_process(COMMAND python3 -c "import ${module}" RESULT_VARIABLE found OUTPUT_QUIET ERROR_QUIET)
  if(NOT found EQUAL 0)
    list(APPEND missing ${package})
  endif()
endmacro()

if(STEP STREQUAL "site")
  # The site needs no tools that compile or draw.
  include("${CMAKE_CURRENT_LIST_DIR}/cmake/site_tools.cmake")
  list(APPEND missing ${missing_site_tools})
else()
  need_program(ninja-build ninja)
  need_program(pkg-config pkg-config pkgconf)
  need_program(gnuplot-nox gnuplot)
  find_file(dejavu DejaVuSans.ttf PATHS /usr/share/fonts /usr/local/share/fonts PATH_SUFFIXES truetype/dejavu TTF dejavu
            dejavu-sans-fonts NO_CACHE)
  if(NOT dejavu)
    list(APPEND missing fonts-dejavu-core)
  endif()
endif()
if(STEP MATCHES "^(test|sanitize)$")
  # The tests open run.xdmf as ParaView does and render it on a virtual display.
  need_python_module(python3-paraview paraview.simple)
  need_program(xvfb xvfb-run)
  need_program(xauth xauth)
  need_program(zsh zsh)
  # They read the text in pictures.
  need_program(poppler-utils pdftotext)
endif()
if(STEP MATCHES "^(test|sanitize|docs)$")
  # The tests, and the pages whose pictures are renewed, open a report in a browser, make a movie and read a run from
  # Python.
  need_program(chromium chromium)
  need_program(chromium-driver chromedriver)
  need_python_module(python3-selenium selenium)
  need_program(ffmpeg ffmpeg)
  need_python_module(python3-h5py h5py)
  need_python_module(python3-numpy numpy)
  need_python_module(python3-matplotlib matplotlib)
endif()
if(STEP STREQUAL "test" AND VEHD_PYTHON)
  # The tests solve with scipy, make a pandas table and execute the notebooks.
  need_python_module(python3-scipy scipy)
  need_python_module(python3-pandas pandas)
  need_python_module(python3-nbconvert nbconvert)
  need_python_module(python3-ipykernel ipykernel)
endif()
if(STEP MATCHES "^(test|sanitize|package)$")
  # These steps make a Debian package of the build, check it and test it.
  need_program(help2man help2man)
  need_program(dpkg-dev dpkg-shlibdeps)
  need_program(lintian lintian)
endif()
if(STEP STREQUAL "archive" OR (STEP STREQUAL "test" AND EXTENDED))
  # These steps make an archive of the build and test it in a bare system.
  need_program(patchelf patchelf)
  need_program(xz-utils xz)
  need_program(mmdebstrap mmdebstrap)
endif()
if(STEP STREQUAL "test" AND OTHER_DEBIAN)
  need_program(mmdebstrap mmdebstrap)
endif()
if(STEP STREQUAL "archive")
  # This step builds the container of the archive.
  need_program(buildah buildah)
endif()
if(STEP STREQUAL "callgrind")
  need_program(valgrind valgrind)
endif()
if(STEP STREQUAL "slurm")
  need_program(slurmctld slurmctld)
  need_program(slurmd slurmd)
  need_program(slurm-client sbatch)
  need_program(munge munged)
endif()
if(STEP MATCHES "^(sanitize|fuzz)$")
  need_program(clang clang++)
  execute_process(COMMAND clang++ -print-runtime-dir OUTPUT_VARIABLE runtime OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                  RESULT_VARIABLE status)
  file(GLOB sanitizers "${runtime}/libclang_rt.asan*")
  if(NOT status EQUAL 0 OR NOT sanitizers)
    list(APPEND missing libclang-rt-dev libomp-dev)
  endif()
endif()

# Prints the names of Debian packages and the command, then installs them. Scripts of packages print errors although nothing
# is wrong (PETSc's alternatives, for example), so the output of apt-get is shown only if it fails.
function(install_packages)
  set(packages ${ARGN})
  list(REMOVE_DUPLICATES packages)
  find_program(apt apt-get NO_CACHE)
  execute_process(COMMAND id -u OUTPUT_VARIABLE user OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(as_root)
  if(NOT user EQUAL 0)
    find_program(sudo sudo NO_CACHE)
    set(as_root sudo)
  endif()
  list(JOIN packages " " names)
  list(JOIN as_root " " prefix)
  set(command "apt-get install --no-install-recommends ${names}")
  if(as_root)
    string(PREPEND command "sudo ")
  endif()
  if(NOT INSTALL OR NOT apt OR (as_root AND NOT sudo))
    message(STATUS "Not installed: ${names}. On Debian and Ubuntu: ${command}; elsewhere: docs/installation.md")
    return()
  endif()
  message(STATUS "Installing: ${names}")
  message(STATUS "with:       ${command}")
  set(log "${build}/installing.log")
  message(STATUS "this takes minutes; output: ${log}")
  file(MAKE_DIRECTORY "${build}")
  execute_process(COMMAND ${as_root} env DEBIAN_FRONTEND=noninteractive ${apt} update -q
                  OUTPUT_FILE "${log}" ERROR_FILE "${log}" RESULT_VARIABLE status)
  if(status EQUAL 0)
    execute_process(COMMAND ${as_root} env DEBIAN_FRONTEND=noninteractive ${apt} install -q -y --no-install-recommends
                            ${packages}
                    OUTPUT_FILE "${log}" ERROR_FILE "${log}" RESULT_VARIABLE status)
  endif()
  if(NOT status EQUAL 0)
    file(READ "${log}" text)
    message(FATAL_ERROR "${text}\nfailed (${status}): ${command}")
  endif()
endfunction()

if(missing)
  install_packages(${missing})
endif()
if(STEP STREQUAL "site")
  run_or_stop("${CMAKE_COMMAND}" -DSITE=${source}/build/site -P bie/cmake/site.cmake)
  return()
endif()
# One compiler process needs up to 2 GB of memory.
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)
math(EXPR jobs "${memory} / 2000")
if(jobs GREATER cores)
  set(jobs ${cores})
elseif(jobs LESS 1)
  set(jobs 1)
endif()

set(options "-DVEHD_ARCHITECTURE=${VEHD_ARCHITECTURE}" -DCMAKE_UNITY_BUILD=ON)
if(STEP MATCHES "^(test|sanitize|faults|slurm|fuzz)$")
  list(APPEND options -DBUILD_TESTING=ON)
else()
  list(APPEND options -DBUILD_TESTING=OFF)
endif()
foreach(option IN ITEMS CMAKE_COMPILE_WARNING_AS_ERROR VEHD_TEST_LEVEL VEHD_MPI)
  if(DEFINED ${option})
    list(APPEND options "-D${option}=${${option}}")
  endif()
endforeach()
if(VEHD_FEM_CHECK OR STEP MATCHES "^(test|build|archive|docs)$")
  # The other steps keep the setting of an existing build.
  list(APPEND options -DVEHD_FEM_CHECK=${VEHD_FEM_CHECK})
endif()
if(VEHD_PYTHON OR STEP MATCHES "^(test|build|package|archive|docs|sanitize)$")
  list(APPEND options -DVEHD_PYTHON=${VEHD_PYTHON})
endif()
set(configure "${CMAKE_COMMAND}")
if(STEP MATCHES "^(sanitize|fuzz)$")
  list(APPEND configure --preset sanitize)
else()
  find_program(ninja ninja NO_CACHE)
  if(ninja AND NOT EXISTS "${build}/CMakeCache.txt")
    list(APPEND configure -G Ninja)
  endif()
  list(APPEND configure -S "${source}" -B "${build}" -DCMAKE_BUILD_TYPE=Release)
endif()
list(APPEND configure ${options})
# The first configuration finds missing libraries. Its messages are shown unless missing libraries are why it stops.
execute_process(COMMAND ${configure} WORKING_DIRECTORY "${source}" RESULT_VARIABLE status OUTPUT_VARIABLE messages
                ERROR_VARIABLE messages)
set(missing_file "${build}/missing_packages.txt")
if(status EQUAL 0 OR NOT EXISTS "${missing_file}")
  message("${messages}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "the configuration failed")
  endif()
else()
  file(READ "${missing_file}" missing)
  install_packages(${missing})
  run_or_stop(${configure})
endif()
if(STEP MATCHES "^(test|sanitize)$")
  run_or_stop("${CMAKE_COMMAND}" --build "${build}" --parallel ${jobs})
  # One test more than there are processors runs at a time, because some wait for the disk, a browser or a process.
  math(EXPR tests "${jobs} + 1")
  set(left_out --label-exclude extended)
  if(EXTENDED OR STEP STREQUAL "sanitize")
    set(left_out)
  endif()
  run_or_stop("${CMAKE_CTEST_COMMAND}" --test-dir "${build}" --parallel ${tests} --output-on-failure
              --tests-regex "${TESTS}" ${left_out})
  if(STEP STREQUAL "test" AND OTHER_DEBIAN)
    run_or_stop("${CMAKE_COMMAND}" -P tests/installed/other_debian.cmake)
  endif()
else()
  set(targets vehd)
  set(fuzzers scene tables files edits)
  if(STEP MATCHES "^(faults|slurm)$")
    list(APPEND targets test_faults)
  elseif(STEP STREQUAL "fuzz")
    list(TRANSFORM fuzzers PREPEND fuzz_ OUTPUT_VARIABLE targets)
  elseif(STEP STREQUAL "python")
    list(APPEND targets vehd_python_example)
  elseif(STEP MATCHES "^(build|docs|check|package|archive)$")
    set(targets all)
  endif()
  run_or_stop("${CMAKE_COMMAND}" --build "${build}" --parallel ${jobs} --target ${targets})
endif()
if(STEP STREQUAL "faults")
  run_or_stop("${build}/test_faults" -- 200 1000)
endif()
if(STEP STREQUAL "slurm")
  set(ENV{VEHD_OWN_SLURM} 1)
  run_or_stop("${build}/test_faults" --run_test=slurm --log_level=message)
endif()
if(STEP STREQUAL "fuzz")
  foreach(fuzzer IN LISTS fuzzers)
    # The fuzzer adds new inputs to the first folder; the second holds the seeds that the tests replay. Leaks are not
    # reported because HDF5 itself leaks memory on damaged files.
    file(MAKE_DIRECTORY "${build}/corpus/${fuzzer}")
    run_or_stop("${build}/fuzz_${fuzzer}" -max_total_time=${SECONDS} -timeout=20 -rss_limit_mb=2048 -detect_leaks=0
                -max_len=8192 -use_value_profile=1 -print_final_stats=1 "-artifact_prefix=${build}/corpus/"
                "${build}/corpus/${fuzzer}" "${source}/tests/fuzz/seeds/${fuzzer}" "${source}/docs/scenes")
  endforeach()
endif()
if(STEP STREQUAL "package")
  set(python)
  if(VEHD_PYTHON STREQUAL "ON")
    set(python -DPYTHON=/usr/bin/python3)
  endif()
  run_or_stop("${CMAKE_COMMAND}" "-DBUILD=${build}" -DLEVELS=2 "-DFOLDER=${build}/installed" ${python} -P
              "${source}/tests/installed/package.cmake")
  file(GLOB packages "${build}/package/*.deb")
  message(STATUS "Install it with: apt-get install ${packages}")
endif()
if(STEP STREQUAL "archive")
  set(python)
  if(VEHD_PYTHON STREQUAL "ON")
    set(python -DPYTHON=/usr/bin/python3)
  endif()
  file(REMOVE_RECURSE "${build}/archive")
  run_or_stop("${CMAKE_COMMAND}" "-DBUILD=${build}" -P "${source}/bie/cmake/archive.cmake")
  run_or_stop("${CMAKE_COMMAND}" "-DBUILD=${build}" "-DSOURCE=${source}" "-DFOLDER=${build}/unpacked" ${python} -P
              "${source}/tests/installed/archive.cmake")
endif()
if(STEP STREQUAL "check")
  run_or_stop("${build}/vehd" check docs/scenes/figure2.toml --quick -o out/figure2_check)
endif()
if(STEP STREQUAL "python")
  message(STATUS "Python finds it with: export PYTHONPATH=${build}/python")
endif()
if(STEP STREQUAL "run")
  # With --resume a second call continues an interrupted run and leaves a complete one unchanged.
  set(simulate "${build}/vehd" run docs/scenes/figure2.toml -o out/figure2 --resume)
  execute_process(COMMAND sh -c ": > /dev/tty" RESULT_VARIABLE no_terminal OUTPUT_QUIET ERROR_QUIET)
  if(no_terminal EQUAL 0)
    # CMake gives its commands a pipe, but the progress bar needs the terminal.
    run_or_stop(sh -c "exec \"$0\" \"$@\" 2> /dev/tty" ${simulate})
  else()
    run_or_stop(${simulate})
  endif()
  message(STATUS "Pictures of the run: out/figure2/plots/shapes.png and history.png")
endif()
if(STEP STREQUAL "callgrind")
  run_or_stop("${CMAKE_COMMAND}" "-DPROGRAM=${build}/vehd" "-DFOLDER=${build}/absent_effects" -P
              "${source}/tests/app/absent_effects.cmake")
endif()
if(STEP STREQUAL "docs")
  run_or_stop("${build}/vehd" bench all)
endif()
