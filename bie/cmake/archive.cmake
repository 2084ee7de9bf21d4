# Makes archives of a build, in BUILD/archive, that run without a package manager: vehd-VERSION-x86_64-linux.tar.xz, and one
# with "plain" in its name that omits the finite elements and all files that only they need:
#   cmake -DBUILD=build-archive -P bie/cmake/archive.cmake
# -DXZ=-1 before -P compresses less, in a tenth of the time.
#
# An archive contains the files of cmake --install and files of this Debian: libraries, Python with numpy, gnuplot with a
# font, and Open MPI, each at its place below /usr. It uses the C library of the system where it is unpacked.
cmake_minimum_required(VERSION 3.25)

if(NOT DEFINED XZ)
  set(XZ "--x86 --lzma2=preset=9e,dict=64MiB")
endif()
get_filename_component(source "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
get_filename_component(BUILD "${BUILD}" ABSOLUTE)
file(STRINGS "${BUILD}/CMakeCache.txt" version REGEX "^CMAKE_PROJECT_VERSION:")
string(REGEX REPLACE ".*=" "" version "${version}")
set(debian_libraries lib/x86_64-linux-gnu)
# Other libraries are linked with these, but vehd never calls them: gnuplot's library for other formats, which needs video
# codecs, and HDF5's libraries for files on the network. They would double the size of an archive.
set(left_out libgd.so.3 libcurl.so.4 libcrypto.so.3)
# The archive omits these parts of Python and numpy: tests, tools for developers, and modules that need omitted libraries.
set(left_out_of_python
    "/(test|tests|idlelib|tkinter|lib2to3|distutils|f2py|ensurepip|turtledemo|pydoc_data|__pycache__|_pyinstaller)/"
    "/lib-dynload/(_ssl|_hashlib|_sqlite3|_curses|_curses_panel|_dbm|_gdbm|_tkinter|nis|_test|_ctypes_test|_xxtest|xx)"
    "/python3\\.[0-9]+/dist-packages/" "/numpy/core/_simd\\." "/sitecustomize\\.py$" "\\.a$")
# The archive omits these plugins of Open MPI: networks and schedulers of clusters, because the check runs on one machine, and
# OpenSHMEM.
set(left_out_of_mpi "_(rsh|ucx|ofi|openib|psm2?|flux|jsm|slurm|gridengine)\\.so$" "/mca_(memheap|spml|scoll|sshmem|atomic)_"
    "dbg_msgq")
# These packages contain only headers, which are compiled into vehd.
set(header_packages libeigen3-dev libboost-dev libcli11-dev nlohmann-json3-dev pybind11-dev)

function(run)
  cmake_parse_arguments(run "" "OUTPUT" "" ${ARGN})
  execute_process(COMMAND ${run_UNPARSED_ARGUMENTS} OUTPUT_VARIABLE text ERROR_VARIABLE problem RESULT_VARIABLE status
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT status EQUAL 0)
    list(JOIN run_UNPARSED_ARGUMENTS " " command)
    message(FATAL_ERROR "failed (${status}): ${command}\n${problem}")
  endif()
  if(run_OUTPUT)
    set(${run_OUTPUT} "${text}" PARENT_SCOPE)
  endif()
endfunction()

# A program that is linked with a newer C library does not start with an older one; the limit is that of docs/archive.md.
run(getconf GNU_LIBC_VERSION OUTPUT c_library)
string(REGEX REPLACE "^glibc " "" c_library "${c_library}")
if(c_library VERSION_GREATER 2.36)
  message(FATAL_ERROR "archives are made on Debian 12: with the glibc ${c_library} of this system they would not run where it \
is older")
endif()

# Copies a file of this system into the archive, following links, and records it for the licences.
function(carry file place)
  file(REAL_PATH "${file}" real)
  get_filename_component(folder "${stage}/${place}" DIRECTORY)
  file(MAKE_DIRECTORY "${folder}")
  file(COPY_FILE "${real}" "${stage}/${place}")
  set_property(GLOBAL APPEND PROPERTY carried "${real}")
endfunction()

# Returns the files of Debian packages below a folder, except those that match one of the patterns after it.
function(files_of_packages result packages folder)
  run(dpkg -L ${packages} OUTPUT text)
  string(REGEX REPLACE "\n" ";" files "${text}")
  list(FILTER files INCLUDE REGEX "^${folder}")
  foreach(pattern IN LISTS ARGN)
    list(FILTER files EXCLUDE REGEX "${pattern}")
  endforeach()
  set(found)
  foreach(file IN LISTS files)
    if(EXISTS "${file}" AND NOT IS_DIRECTORY "${file}")
      list(APPEND found "${file}")
    endif()
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# Returns the symbols of libraries and programs, each with its version.
function(symbols_of result kind)
  run(nm -D ${kind} ${ARGN} OUTPUT text)
  string(REGEX MATCHALL " [A-Za-z] [^\n]+" symbols "${text}")
  list(TRANSFORM symbols REPLACE "^ . " "")
  list(TRANSFORM symbols REPLACE "@@" "@")
  list(REMOVE_DUPLICATES symbols)
  set(${result} "${symbols}" PARENT_SCOPE)
endfunction()

# Replaces an omitted library by one with the functions that other files are linked with; each ends the program if called.
function(replace_library name)
  execute_process(COMMAND grep -rlF ${name} "${stage}/${debian_libraries}" "${stage}/lib/vehd/programs" OUTPUT_VARIABLE users
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT users)
    return()
  endif()
  string(REPLACE "\n" ";" users "${users}")
  # All symbols count, not only undefined ones: programs hold copies of variables, which the library initialises.
  symbols_of(wanted --format=bsd ${users})
  symbols_of(known --defined-only /usr/${debian_libraries}/${name})
  set(code "#include <stdio.h>\n#include <stdlib.h>\nvoid absent(void) {\n\
  fputs(\"${name} is no part of the archive of vehd\\n\", stderr);\n  abort();\n}\n")
  set(node)
  foreach(symbol IN LISTS wanted)
    if(symbol IN_LIST known AND NOT symbol MATCHES "^_")
      string(REGEX MATCH "^[^@]+" function "${symbol}")
      string(APPEND code "void ${function}(void) __attribute__((alias(\"absent\")));\n")
      if(symbol MATCHES "@(.+)$")
        set(node "${CMAKE_MATCH_1}")
      endif()
    endif()
  endforeach()
  set(options)
  if(node)
    file(WRITE "${work}/${name}.map" "${node} { *; };\n")
    set(options "-Wl,--version-script=${work}/${name}.map")
  endif()
  file(WRITE "${work}/${name}.c" "${code}")
  run(cc -shared -fPIC -O1 -fno-builtin -w "-Wl,-soname,${name}" ${options} -s -o "${stage}/${debian_libraries}/${name}"
      "${work}/${name}.c")
endfunction()

# Copies the libraries that the programs and modules in the archive need, except the omitted ones and those of the C library,
# which the system must provide.
function(carry_libraries)
  file(GLOB_RECURSE programs "${stage}/bin/*" "${stage}/lib/vehd/programs/*")
  file(GLOB_RECURSE modules "${stage}/lib/*.so" "${stage}/lib/vehd/*.so.*")
  list(TRANSFORM left_out REPLACE "\\." "\\\\." OUTPUT_VARIABLE excluded)
  file(GET_RUNTIME_DEPENDENCIES EXECUTABLES ${programs} MODULES ${modules} RESOLVED_DEPENDENCIES_VAR libraries
       PRE_EXCLUDE_REGEXES ${excluded} "^libvehd_" POST_EXCLUDE_REGEXES "^${stage}"
       CONFLICTING_DEPENDENCIES_PREFIX conflicting)
  files_of_packages(c_library libc6 /)
  list(TRANSFORM c_library REPLACE ".*/" "")
  foreach(name IN LISTS conflicting_FILENAMES)
    # The same file was found by two paths.
    list(GET conflicting_${name} 0 path)
    list(APPEND libraries "${path}")
  endforeach()
  foreach(library IN LISTS libraries)
    get_filename_component(name "${library}" NAME)
    if(NOT name IN_LIST c_library)
      carry("${library}" ${debian_libraries}/${name})
    endif()
  endforeach()
endfunction()

function(carry_python)
  file(GLOB core "${stage}/lib/python3/dist-packages/vehd/_core.cpython-*.so")
  if(NOT core)
    return()
  endif()
  string(REGEX REPLACE ".*/_core\\.cpython-3([0-9]+)-.*" "python3.\\1" python "${core}")
  files_of_packages(files "${python}-minimal;lib${python}-minimal;lib${python}-stdlib;python3-numpy" /usr/lib/python3
                    ${left_out_of_python})
  foreach(file IN LISTS files)
    string(REPLACE "/usr/" "" place "${file}")
    carry("${file}" "${place}")
  endforeach()
  carry(/usr/bin/${python} bin/vehd-python)
endfunction()

function(carry_gnuplot)
  find_program(gnuplot NAMES gnuplot-nox gnuplot REQUIRED NO_CACHE)
  carry("${gnuplot}" lib/vehd/programs/gnuplot)
  carry(/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf share/fonts/truetype/dejavu/DejaVuSans.ttf)
  file(WRITE "${stage}/share/vehd/fonts.conf" [=[
<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>
  <dir prefix="relative">../fonts</dir>
  <cachedir prefix="xdg">fontconfig</cachedir>
</fontconfig>
]=])
endfunction()

function(carry_mpi)
  carry(/usr/bin/orterun lib/vehd/programs/mpirun)
  foreach(folder IN ITEMS ${debian_libraries}/openmpi/lib/openmpi3 ${debian_libraries}/pmix2/lib/pmix
                          ${debian_libraries}/pmix2/share share/openmpi)
    file(GLOB_RECURSE files "/usr/${folder}/*.so" "/usr/${folder}/*.txt")
    foreach(pattern IN LISTS left_out_of_mpi)
      list(FILTER files EXCLUDE REGEX "${pattern}")
    endforeach()
    foreach(file IN LISTS files)
      string(REPLACE "/usr/" "" place "${file}")
      carry("${file}" "${place}")
    endforeach()
  endforeach()
endfunction()

# Programs and modules of Python search for libraries relative to their own place first, whatever LD_LIBRARY_PATH a cluster
# sets. Their path also applies to the libraries that they load, so these lose the paths that Debian has set.
function(set_run_paths)
  file(GLOB_RECURSE programs "${stage}/bin/*" "${stage}/lib/vehd/programs/*")
  file(GLOB_RECURSE own "${stage}/lib/vehd/*.so.*")
  file(GLOB_RECURSE modules "${stage}/lib/python3/*.so")
  foreach(file IN LISTS programs own modules)
    if(NOT IS_SYMLINK "${file}")
      get_filename_component(folder "${file}" DIRECTORY)
      file(RELATIVE_PATH to_own "${folder}" "${stage}/lib/vehd")
      file(RELATIVE_PATH to_debian "${folder}" "${stage}/${debian_libraries}")
      run(patchelf --force-rpath --set-rpath "$ORIGIN/${to_own}:$ORIGIN/${to_debian}" "${file}")
    endif()
  endforeach()
  file(GLOB_RECURSE libraries "${stage}/${debian_libraries}/*.so*")
  foreach(file IN LISTS libraries)
    run(patchelf --print-rpath "${file}" OUTPUT path)
    if(path)
      run(patchelf --remove-rpath "${file}")
    endif()
  endforeach()
endfunction()

# Copies the copyright file of every package with a file in the archive and the licence texts that it names, and writes the
# versions, by which Debian's archive finds the sources.
function(write_licences)
  get_property(files GLOBAL PROPERTY carried)
  list(REMOVE_DUPLICATES files)
  # dpkg lists some files without their leading /usr.
  list(TRANSFORM files REPLACE "^/usr/lib/x" "/lib/x" OUTPUT_VARIABLE other_names)
  execute_process(COMMAND dpkg -S ${files} ${other_names} OUTPUT_VARIABLE owners ERROR_QUIET)
  string(REGEX MATCHALL "(^|\n)[^ \n]+: [^\n]+" lines "${owners}")
  set(packages ${header_packages})
  set(owned)
  foreach(line IN LISTS lines)
    if(line MATCHES "^\n?([^ ]+): (.*)$")
      list(APPEND packages "${CMAKE_MATCH_1}")
      list(APPEND owned "${CMAKE_MATCH_2}")
    endif()
  endforeach()
  list(TRANSFORM owned REPLACE "^/lib/" "/usr/lib/")
  list(REMOVE_ITEM files ${owned})
  if(files)
    message(FATAL_ERROR "no package of Debian has these files, so their licences are not known: ${files}")
  endif()
  list(REMOVE_DUPLICATES packages)
  foreach(package IN LISTS packages)
    string(REGEX REPLACE ":.*" "" name "${package}")
    configure_file(/usr/share/doc/${name}/copyright "${stage}/licences/${name}.txt" COPYONLY)
  endforeach()
  file(COPY /usr/share/common-licenses DESTINATION "${stage}/licences" FOLLOW_SYMLINK_CHAIN)
  run(dpkg-query -W -f "\${Package} \${Version} of \${source:Package} \${source:Version}\\n" ${packages} OUTPUT versions)
  file(WRITE "${stage}/licences/packages" "\
Files of these packages of Debian are in this archive, or compiled into its programs. Debian has their sources.\n\n${versions}\n")
endfunction()

function(make_archive name with_elements)
  set(work "${BUILD}/archive")
  set(stage "${work}/${name}")
  file(REMOVE_RECURSE "${stage}")
  set_property(GLOBAL PROPERTY carried "")
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${stage}" --strip)
  file(REMOVE_RECURSE "${stage}/include" "${stage}/lib/cmake" "${stage}/share/doc")
  file(COPY "${source}/README.md" "${source}/CHANGELOG.md" "${source}/CITATION.cff" "${source}/LICENSE"
            "${source}/docs/containers/Containerfile" "${source}/docs/containers/vehd.def" DESTINATION "${stage}")
  if(with_elements)
    carry_mpi()
  else()
    file(REMOVE "${stage}/bin/vehd_fem")
  endif()
  carry_gnuplot()
  carry_python()
  carry_libraries()
  foreach(library IN LISTS left_out)
    replace_library(${library})
  endforeach()
  set_run_paths()
  write_licences()
  execute_process(COMMAND git -C "${source}" log -1 --format=%ct OUTPUT_VARIABLE time OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(time STREQUAL "")
    set(time 0)
  endif()
  run(tar -C "${work}" --sort=name --owner=0 --group=0 --numeric-owner --mode=go=u-w "--mtime=@${time}" -I "xz -T1 ${XZ}" -cf
      "${stage}.tar.xz" ${name})
  file(SIZE "${stage}.tar.xz" size)
  math(EXPR tenths "(${size} + 50000) / 100000")
  string(REGEX REPLACE "(.)$" ".\\1" megabytes "${tenths}")
  message(STATUS "${stage}.tar.xz: ${megabytes} MB")
endfunction()

make_archive(vehd-${version}-plain-x86_64-linux OFF)
if(EXISTS "${BUILD}/vehd_fem")
  make_archive(vehd-${version}-x86_64-linux ON)
endif()
