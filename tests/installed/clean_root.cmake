# Installs a package as an administrator would, into a Debian 12 with only apt, and continues to the first picture, and
# to Example 1 from Python; prints how long both take:
#   cmake -DPACKAGE=vehd.deb -DFOLDER=work -P clean_root.cmake
# It needs root that may mount, mmdebstrap or debootstrap, and the network; without root or these programs it is skipped.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/expect.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/bare_debian.cmake")

find_program(mmdebstrap mmdebstrap NO_CACHE)
find_program(debootstrap debootstrap NO_CACHE)
try_to_mount(problem)
if(problem OR NOT (mmdebstrap OR debootstrap))
  message(STATUS "skipped: needs unshare, root that may mount, and mmdebstrap or debootstrap (Debian packages)")
  return()
endif()

# A bare system, made only once.
set(root "${FOLDER}/root")
if(NOT EXISTS "${FOLDER}/bare.tar")
  file(REMOVE_RECURSE "${FOLDER}")
  file(MAKE_DIRECTORY "${FOLDER}")
  if(mmdebstrap)
    make_bare_debian(problem bookworm "${FOLDER}/bare.tar")
    if(problem)
      message(FATAL_ERROR "${problem}")
    endif()
  else()
    expect("" "${debootstrap}" --variant=minbase bookworm "${root}")
    expect("" tar -C "${root}" -cf "${FOLDER}/bare.tar" .)
  endif()
endif()
file(REMOVE_RECURSE "${root}")
file(MAKE_DIRECTORY "${root}")
expect("" tar -C "${root}" --exclude=./dev/* -xf "${FOLDER}/bare.tar")
configure_file(/etc/resolv.conf "${root}/etc/resolv.conf" COPYONLY)
configure_file("${PACKAGE}" "${root}/vehd.deb" COPYONLY)

# Runs a line of shell within the system; its /proc and /dev are unmounted at the end of the line.
function(within seconds line)
  string(TIMESTAMP start "%s")
  expect("${ARGN}" unshare --mount sh -c
         "mount -t proc proc '${root}/proc' && mount --rbind /dev '${root}/dev' && exec chroot '${root}' /usr/bin/env -i \
HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive sh -c 'cd /root && ${line}'")
  string(TIMESTAMP end "%s")
  math(EXPR taken "${end} - ${start}")
  set(${seconds} ${taken} PARENT_SCOPE)
endfunction()

within(updated "apt-get update -q")
within(installed "apt-get install -q -y /vehd.deb")
within(ran "vehd examples figure2 && vehd run figure2.toml" "picture: out/figure2/plots/shapes.png")
if(NOT EXISTS "${root}/root/out/figure2/plots/shapes.png")
  message(FATAL_ERROR "no picture")
endif()
# The Python module is tested if the package has it; the recommended packages bring python3 and numpy.
execute_process(COMMAND dpkg-deb --field "${PACKAGE}" Provides OUTPUT_VARIABLE provided COMMAND_ERROR_IS_FATAL ANY)
if(provided MATCHES python3-vehd)
  within(imported "python3 -m vehd" "degree 16: error of q")
endif()
math(EXPR sum "${installed} + ${ran}")
message(STATUS "lists of packages ${updated} s; installed in ${installed} s; first picture ${ran} s after that: ${sum} s")
