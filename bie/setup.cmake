# From a fresh Debian 12 with git, cmake and g++ to a result; run it from anywhere:
#   cmake -P bie/setup.cmake               installs what is missing, builds, simulates Example 2 of the paper
#   cmake -DSTEP=test -P bie/setup.cmake   installs what is missing, builds, runs the tests
#   cmake -DSTEP=build -P bie/setup.cmake  installs what is missing, builds
#   cmake -DSTEP=check -P bie/setup.cmake  installs deal.II and gmsh as well, builds the finite-element check, compares the
#                                          two methods on the first shape of Example 2
#   cmake -DSTEP=callgrind -P bie/setup.cmake  installs valgrind, counts the instructions of a run without electricity:
#                                              none in electric code, next to none in bookkeeping
#   cmake -DSTEP=faults -P bie/setup.cmake    kills a run 200 times and breaks its files and its disk in every other way
#   cmake -DSTEP=sanitize -P bie/setup.cmake  installs clang, runs all tests under address and undefined-behaviour
#                                             sanitizers
#   cmake -DSTEP=fuzz -P bie/setup.cmake      installs clang, fuzzes each reader of files for 10 minutes; -DSECONDS=60
#                                             before -P for another time
#   cmake -DSTEP=docs -P bie/setup.cmake   renews every picture and table of the pages that the program measures itself
# Before -P, for every step:
#   -DVEHD_FEM_CHECK=ON             test, build and docs include the finite-element check and install what it needs; without
#                                   it they include the check where deal.II and gmsh are there already
#   -DVEHD_ARCHITECTURE=x86-64-v3   builds for this instruction set, in build-x86-64-v3, instead of that of this machine
#   -DCMAKE_COMPILE_WARNING_AS_ERROR=ON   a warning of the compiler ends the build
cmake_minimum_required(VERSION 3.25)

get_filename_component(source "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)
# A folder for each instruction set: none is compiled again because another was in between.
set(build "${source}/build")
if(NOT DEFINED VEHD_ARCHITECTURE)
  set(VEHD_ARCHITECTURE native)
elseif(NOT VEHD_ARCHITECTURE STREQUAL "native")
  set(build "${source}/build-${VEHD_ARCHITECTURE}")
endif()
if(NOT DEFINED STEP)
  set(STEP run)
endif()
if(NOT STEP MATCHES "^(run|test|build|check|callgrind|faults|sanitize|fuzz|docs)$")
  message(FATAL_ERROR
          "STEP is \"${STEP}\"; accepted: run, test, build, check, callgrind, faults, sanitize, fuzz, docs")
endif()
if(NOT DEFINED SECONDS)
  set(SECONDS 600)
endif()

set(packages ninja-build pkg-config libeigen3-dev libfftw3-dev libhdf5-dev zlib1g-dev libboost-test-dev libtomlplusplus-dev
             libcli11-dev libfmt-dev libspdlog-dev nlohmann-json3-dev gnuplot-nox fonts-dejavu-core)
if(STEP MATCHES "^(test|sanitize)$")
  # The tests open run.xdmf as ParaView does and render it on a virtual display.
  list(APPEND packages python3-paraview xvfb xauth)
endif()
if(STEP STREQUAL "callgrind")
  list(APPEND packages valgrind)
  # Valgrind does not know the instructions of every new processor: those that the compiler takes by itself.
  set(VEHD_ARCHITECTURE "")
  set(build "${source}/build-callgrind")
endif()
if(STEP MATCHES "^(sanitize|fuzz)$")
  list(APPEND packages clang libclang-rt-dev libomp-dev)
  set(build "${source}/build-sanitize")
endif()
# libdeal.ii-dev brings Trilinos and Open MPI.
set(fem_packages libdeal.ii-dev libgmsh-dev)

function(run_or_stop)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY "${source}" RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${status}): ${command}")
  endif()
endfunction()

function(find_missing_packages result)
  set(missing)
  foreach(package IN LISTS ARGN)
    execute_process(COMMAND dpkg-query -W "-f=\${Status}" ${package} OUTPUT_VARIABLE status ERROR_QUIET
                    RESULT_VARIABLE unknown)
    if(NOT unknown EQUAL 0 OR NOT status STREQUAL "install ok installed")
      list(APPEND missing ${package})
    endif()
  endforeach()
  set(${result} ${missing} PARENT_SCOPE)
endfunction()

if(STEP STREQUAL "check")
  set(VEHD_FEM_CHECK ON)
elseif(NOT DEFINED VEHD_FEM_CHECK)
  find_missing_packages(missing ${fem_packages})
  set(VEHD_FEM_CHECK OFF)
  if(NOT missing AND STEP MATCHES "^(test|build|docs)$")
    set(VEHD_FEM_CHECK ON)
  endif()
endif()
if(VEHD_FEM_CHECK)
  list(APPEND packages ${fem_packages})
endif()
find_missing_packages(missing ${packages})
if(missing)
  list(JOIN missing " " names)
  message(STATUS "Installing ${names}")
  execute_process(COMMAND id -u OUTPUT_VARIABLE user OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(apt env DEBIAN_FRONTEND=noninteractive apt-get)
  if(NOT user EQUAL 0)
    find_program(sudo sudo)
    if(NOT sudo)
      message(FATAL_ERROR "missing packages: ${names}; install them as root, or install sudo")
    endif()
    list(PREPEND apt ${sudo})
  endif()
  run_or_stop(${apt} update -q)
  run_or_stop(${apt} install -q -y --no-install-recommends ${missing})
endif()

# One compiler needs up to 2 GB of memory.
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)
math(EXPR jobs "${memory} / 2000")
if(jobs GREATER cores)
  set(jobs ${cores})
elseif(jobs LESS 1)
  set(jobs 1)
endif()

set(generator)
if(NOT EXISTS "${build}/CMakeCache.txt")
  set(generator -G Ninja)
endif()
set(options "-DVEHD_ARCHITECTURE=${VEHD_ARCHITECTURE}" -DCMAKE_UNITY_BUILD=ON)
if(DEFINED CMAKE_COMPILE_WARNING_AS_ERROR)
  list(APPEND options -DCMAKE_COMPILE_WARNING_AS_ERROR=${CMAKE_COMPILE_WARNING_AS_ERROR})
endif()
if(VEHD_FEM_CHECK OR STEP MATCHES "^(test|build|docs)$")
  # The other steps leave a build with the check as it is.
  list(APPEND options -DVEHD_FEM_CHECK=${VEHD_FEM_CHECK})
endif()
if(STEP MATCHES "^(sanitize|fuzz)$")
  run_or_stop("${CMAKE_COMMAND}" --preset sanitize ${options})
else()
  run_or_stop("${CMAKE_COMMAND}" ${generator} -S "${source}" -B "${build}" -DCMAKE_BUILD_TYPE=Release ${options})
endif()
if(STEP MATCHES "^(test|sanitize)$")
  run_or_stop("${CMAKE_COMMAND}" --build "${build}" --parallel ${jobs})
  run_or_stop("${CMAKE_CTEST_COMMAND}" --test-dir "${build}" --parallel ${jobs} --output-on-failure)
else()
  set(targets vehd)
  set(fuzzers scene tables files edits)
  if(STEP STREQUAL "faults")
    list(APPEND targets test_faults)
  elseif(STEP STREQUAL "fuzz")
    list(TRANSFORM fuzzers PREPEND fuzz_ OUTPUT_VARIABLE targets)
  endif()
  if(VEHD_FEM_CHECK)
    list(APPEND targets vehd_fem_program)
  endif()
  run_or_stop("${CMAKE_COMMAND}" --build "${build}" --parallel ${jobs} --target ${targets})
endif()
if(STEP STREQUAL "faults")
  run_or_stop("${build}/test_faults" -- 200)
endif()
if(STEP STREQUAL "fuzz")
  foreach(fuzzer IN LISTS fuzzers)
    # New finds go to the first folder; the second holds the seeds that the tests replay. Leaks of HDF5 on damaged files
    # are not this program's to mend.
    file(MAKE_DIRECTORY "${build}/corpus/${fuzzer}")
    run_or_stop("${build}/fuzz_${fuzzer}" -max_total_time=${SECONDS} -timeout=20 -rss_limit_mb=2048 -detect_leaks=0
                -max_len=8192 -use_value_profile=1 -print_final_stats=1 "-artifact_prefix=${build}/corpus/"
                "${build}/corpus/${fuzzer}" "${source}/tests/fuzz/seeds/${fuzzer}" "${source}/docs/scenes")
  endforeach()
endif()
if(STEP STREQUAL "check")
  run_or_stop("${build}/vehd" check docs/scenes/figure2.toml --quick -o out/figure2_check)
endif()
if(STEP STREQUAL "run")
  # --resume: a second call continues an interrupted run and leaves a complete one alone.
  set(simulate "${build}/vehd" run docs/scenes/figure2.toml -o out/figure2 --resume)
  execute_process(COMMAND sh -c ": > /dev/tty" RESULT_VARIABLE no_terminal OUTPUT_QUIET ERROR_QUIET)
  if(no_terminal EQUAL 0)
    # CMake hands a pipe to its commands; the progress bar wants the terminal itself.
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
