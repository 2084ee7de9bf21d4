# Messages and actions of bie/setup.cmake if something is missing: in a folder with only that file, a configuration that
# lacks a library, and an apt-get that only records its arguments, prints errors, and fails on request. Then .ci/run with a
# cmake that only prints its arguments, other_debian.cmake where mounting is forbidden, and archives with a C library that
# is too new:
#   cmake -DSOURCE=source -DFOLDER=work -P setup.cmake
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/bie" "${FOLDER}/bin")
configure_file("${SOURCE}/bie/setup.cmake" "${FOLDER}/bie/setup.cmake" COPYONLY)
file(WRITE "${FOLDER}/CMakeLists.txt" [=[
cmake_minimum_required(VERSION 3.25)
project(incomplete LANGUAGES NONE)
if(NOT EXISTS "${CMAKE_SOURCE_DIR}/installed")
  file(WRITE "${CMAKE_BINARY_DIR}/missing_packages.txt" "libimaginary-dev;librare-dev")
  message(FATAL_ERROR "Not found: imaginary, rare")
endif()
add_custom_target(vehd COMMAND ${CMAKE_COMMAND} -E echo built)
add_custom_target(everything ALL DEPENDS vehd)
]=])
file(WRITE "${FOLDER}/bin/apt-get" "#!/bin/sh\necho \"$*\" >> \"${FOLDER}/calls\"
echo 'alternatives: error: nothing' >&2\ntest ! -e \"${FOLDER}/offline\" && touch \"${FOLDER}/installed\"\n")
file(WRITE "${FOLDER}/bin/sudo" "#!/bin/sh\nexec \"$@\"\n")
file(CHMOD "${FOLDER}/bin/apt-get" "${FOLDER}/bin/sudo" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)

function(run_setup result output)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PATH=${FOLDER}/bin:$ENV{PATH}" "${CMAKE_COMMAND}" -DSTEP=build ${ARGN}
                          -P "${FOLDER}/bie/setup.cmake"
                  OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
  set(${result} "${status}" PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()
function(require text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "not printed: ${pattern}\n${text}")
  endif()
endfunction()

run_setup(status text -DINSTALL=OFF)
require("${text}" "Not installed: [^\n]*libimaginary-dev librare-dev[^\n]*apt-get install --no-install-recommends")
if(status EQUAL 0 OR EXISTS "${FOLDER}/calls")
  message(FATAL_ERROR "-DINSTALL=OFF installed, or went on without what is missing (${status}):\n${text}")
endif()

file(TOUCH "${FOLDER}/offline")
run_setup(status text)
require("${text}" "alternatives: error: nothing")
if(status EQUAL 0)
  message(FATAL_ERROR "a failed installation went on:\n${text}")
endif()
file(REMOVE "${FOLDER}/offline" "${FOLDER}/calls")

run_setup(status text)
if(text MATCHES "error")
  message(FATAL_ERROR "shows what apt-get says although it has succeeded:\n${text}")
endif()
require("${text}" "Installing: [^\n]*libimaginary-dev librare-dev")
require("${text}" "with: +[^\n]*apt-get install --no-install-recommends [^\n]*libimaginary-dev librare-dev")
file(READ "${FOLDER}/calls" calls)
require("${calls}" "install -q -y --no-install-recommends [^\n]*libimaginary-dev librare-dev")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "with all installed the build failed (${status}):\n${text}")
endif()

# Without any other program the set-up needs all that its options name.
set(path "$ENV{PATH}")
set(ENV{PATH} "")
run_setup(status text -DINSTALL=OFF -DSTEP=test)
if(text MATCHES "mmdebstrap")
  message(FATAL_ERROR "needs mmdebstrap without the other Debian:\n${text}")
endif()
run_setup(status text -DINSTALL=OFF -DSTEP=test -DOTHER_DEBIAN=ON)
require("${text}" "Not installed: [^\n]*mmdebstrap")
set(ENV{PATH} "${path}")

# .ci/run is the test command of the README and adds what its options name.
file(WRITE "${FOLDER}/bin/cmake" "#!/bin/sh\necho \"$*\"\n")
file(WRITE "${FOLDER}/bin/unshare" "#!/bin/sh\nexit 1\n")
file(CHMOD "${FOLDER}/bin/cmake" "${FOLDER}/bin/unshare" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
set(ENV{PATH} "${FOLDER}/bin:${path}")
function(run_ci arguments expected)
  execute_process(COMMAND "${SOURCE}/.ci/run" ${arguments} OUTPUT_VARIABLE text ERROR_VARIABLE text)
  require("${text}" "^${expected}\n$")
endfunction()
set(strict "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON -DSTEP=test")
set(extended "-DEXTENDED=ON -DVEHD_TEST_LEVEL=x86-64-v3")
run_ci("" "${strict} -P bie/setup.cmake")
run_ci(--extended "${strict} ${extended} -P bie/setup.cmake")
run_ci("--other-debian;--extended" "${strict} -DOTHER_DEBIAN=ON ${extended} -P bie/setup.cmake")
run_ci("--extended;--other" ".ci/run: unknown option --other; accepted: --extended, --other-debian")

execute_process(COMMAND "${CMAKE_COMMAND}" -P "${SOURCE}/tests/installed/other_debian.cmake" OUTPUT_VARIABLE text
                ERROR_VARIABLE text RESULT_VARIABLE status)
require("${text}" "skipped: a system of Debian [a-z]+: it needs unshare, and root that may mount")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "other_debian.cmake failed (${status}):\n${text}")
endif()

# Programs that claim to mount, to change run paths, and that the C library is that of Debian 13.
foreach(program IN ITEMS unshare patchelf getconf)
  file(WRITE "${FOLDER}/bin/${program}" "#!/bin/sh\necho glibc 2.41\n")
  file(CHMOD "${FOLDER}/bin/${program}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endforeach()
execute_process(COMMAND "${CMAKE_COMMAND}" "-DBUILD=${FOLDER}/build" "-DSOURCE=${SOURCE}" -DMAKE=ON -P
                        "${SOURCE}/tests/installed/archive.cmake"
                OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE status)
require("${text}" "Not tried: archives are made on Debian 12")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "archive.cmake failed (${status}):\n${text}")
endif()
