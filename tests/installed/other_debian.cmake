# Builds and tests the last commit as a newcomer would, in a bare system of the other Debian release: 13, or 12 if this
# is a 13. The system and the build in it stay in ${XDG_CACHE_HOME:-~/.cache}/vehd for the next time:
#   cmake -P other_debian.cmake
# Before -P: -DRELEASE=trixie for another release, -DTESTS=REGEX for other tests than those of Python and the notebooks,
# "." for all, -DEXTENDED=OFF for the ordinary ones of them. It needs root, mmdebstrap, git and the network; if the
# system cannot be made or entered it reports that and ends.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/bare_debian.cmake")

if(NOT DEFINED TESTS)
  set(TESTS "^(python/|notebooks)")
endif()
if(NOT DEFINED EXTENDED)
  set(EXTENDED ON)
endif()
if(NOT DEFINED RELEASE)
  set(RELEASE trixie)
  file(STRINGS /etc/os-release native REGEX "^VERSION_CODENAME=trixie")
  if(native)
    set(RELEASE bookworm)
  endif()
endif()
try_to_mount(problem)
if(problem)
  message(STATUS "skipped: a system of Debian ${RELEASE}: ${problem}")
  return()
endif()
cache_folder(cache)
set(root "${cache}/${RELEASE}")
make_bare_debian(problem "${RELEASE}" "${root}" --include=ca-certificates,cmake,g++,git)
if(problem)
  message(STATUS "skipped: ${problem}")
  return()
endif()

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
if(NOT EXISTS "${root}/root/vehd")
  run(git init -q "${root}/root/vehd")
endif()
run(git -C "${root}/root/vehd" fetch -q "${CMAKE_CURRENT_LIST_DIR}/../.." HEAD)
run(git -C "${root}/root/vehd" checkout -q --force --detach FETCH_HEAD)
# Runs of an earlier commit, which this one may not be able to continue.
file(REMOVE_RECURSE "${root}/root/vehd/out")

# Runs a line of shell within the system, in the folder of the README; /proc, /dev and /sys are unmounted at its end.
function(within line)
  string(TIMESTAMP start "%s")
  run(cp /etc/resolv.conf "${root}/etc/resolv.conf")
  run(unshare --mount --pid --fork sh -c
      "mount -t proc proc '${root}/proc' && mount --rbind /dev '${root}/dev' && mount --rbind /sys '${root}/sys' && exec chroot '${root}' /usr/bin/env -i \
HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c 'cd /root/vehd && ${line}'")
  string(TIMESTAMP end "%s")
  math(EXPR taken "${end} - ${start}")
  message(STATUS "Debian ${RELEASE}: ${taken} s for: ${line}")
endfunction()

set(strict -DCMAKE_COMPILE_WARNING_AS_ERROR=ON)
within("cmake ${strict} -P bie/setup.cmake")
within("cmake ${strict} -DSTEP=check -P bie/setup.cmake")
within("build/vehd check docs/checks/shape33.toml --quick -o out/shape33_check")
within("cmake ${strict} -DSTEP=test -DEXTENDED=${EXTENDED} \"-DTESTS=${TESTS}\" -P bie/setup.cmake")
