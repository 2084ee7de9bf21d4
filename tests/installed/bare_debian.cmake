# A Debian that has nothing beside apt and what is asked for, to try vehd in; where it can be made it is made once, and stays
# for the next time.

# ${XDG_CACHE_HOME:-~/.cache}/vehd
function(cache_folder result)
  set(cache "$ENV{XDG_CACHE_HOME}")
  if(cache STREQUAL "")
    set(cache "$ENV{HOME}/.cache")
  endif()
  file(MAKE_DIRECTORY "${cache}/vehd")
  set(${result} "${cache}/vehd" PARENT_SCOPE)
endfunction()

# Makes one of a release at a place that has none: in a folder, or in a file if the place ends with .tar. The options after
# it are mmdebstrap's. PROBLEM is empty, or why there is none.
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
  # From where this system has its own packages.
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
