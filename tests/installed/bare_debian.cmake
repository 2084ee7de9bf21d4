# A Debian with only apt and the requested packages, in which vehd is tested; it is made once, if it can be made, and
# kept for the next time.

# ${XDG_CACHE_HOME:-~/.cache}/vehd
function(cache_folder result)
  set(cache "$ENV{XDG_CACHE_HOME}")
  if(cache STREQUAL "")
    set(cache "$ENV{HOME}/.cache")
  endif()
  file(MAKE_DIRECTORY "${cache}/vehd")
  set(${result} "${cache}/vehd" PARENT_SCOPE)
endfunction()

# PROBLEM is empty, or the reason why programs cannot be run within another system: containers may forbid to mount there.
function(try_to_mount problem)
  execute_process(COMMAND unshare --mount --pid --fork mount -t proc proc /proc RESULT_VARIABLE status ERROR_QUIET)
  set(${problem} "" PARENT_SCOPE)
  if(NOT status EQUAL 0)
    set(${problem} "it needs unshare, and root that may mount" PARENT_SCOPE)
  endif()
endfunction()

# Makes a bare system of a release at a place that has none: in a folder, or in a file if the place ends with .tar. The
# further options are passed to mmdebstrap. PROBLEM is empty, or the reason why there is none.
function(make_bare_debian problem release place)
  set(${problem} "" PARENT_SCOPE)
  if(EXISTS "${place}")
    return()
  endif()
  find_program(mmdebstrap mmdebstrap NO_CACHE)
  if(NOT mmdebstrap)
    set(${problem} "a system of Debian ${release} needs mmdebstrap (a Debian package)" PARENT_SCOPE)
    return()
  endif()
  set(format directory)
  if(place MATCHES "\\.tar$")
    set(format tar)
  endif()
  # The mirror from which this system has its own packages.
  execute_process(COMMAND apt-get indextargets --format "$(REPO_URI)" "Component: main" "ShortDesc: Packages" "Origin: Debian"
                  OUTPUT_VARIABLE mirrors ERROR_QUIET)
  string(REGEX MATCH "^[^\n]*" mirror "${mirrors}")
  file(REMOVE_RECURSE "${place}.new")
  execute_process(COMMAND "${mmdebstrap}" --quiet --variant=apt --format=${format} ${ARGN} "${release}" "${place}.new"
                          ${mirror} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    set(${problem} "mmdebstrap cannot make a system of Debian ${release} (${status})" PARENT_SCOPE)
    return()
  endif()
  file(RENAME "${place}.new" "${place}")
endfunction()
