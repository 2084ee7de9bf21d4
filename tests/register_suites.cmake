# Read by ctest itself, not when the build is configured: a new suite becomes an entry as soon as it is compiled.
cmake_policy(VERSION 3.25)

# Every suite of a test program becomes an entry MODULE/SUITE. Its labels are the given ones and those of the suite in
# its source: BOOST_AUTO_TEST_SUITE(name, *boost::unit_test::label("slow")). Time limits only stop tests that hang, on
# any machine: about ten times the duration of a suite, times SLOWER. Slow suites start first. Each has one thread,
# unless OMP_NUM_THREADS says otherwise, so that as many can run at once as there are processors; one that is labelled
# "alone" has them all.
#
# Freed memory is kept, as in the program (keep_freed_memory): releasing and reallocating it took a quarter of the time.
# Threads wait as those of the program do (main.cpp); otherwise it would restart itself to set this, which took half of
# the time of tests that start it often. Installed programs are tested without these settings (installed/).
#
# A suite that prints "Not tried: " is shown as skipped.
#
# With OTHER_LIBRARIES, a folder of numerical libraries for another instruction set, each suite that is labelled neither
# "fem" nor "once" is run with them as well, as other/MODULE/SUITE.
function(register_suites)
  cmake_parse_arguments(tests "" "PROGRAM;MODULE;FOLDER;SLOWER;OTHER_LIBRARIES" "LABELS;ENVIRONMENT" ${ARGN})
  if(NOT EXISTS "${tests_PROGRAM}")
    add_test(${tests_MODULE} "${tests_PROGRAM}")
    set_tests_properties(${tests_MODULE} PROPERTIES LABELS "${tests_LABELS}")
    return()
  endif()
  execute_process(COMMAND "${tests_PROGRAM}" --list_content=DOT OUTPUT_VARIABLE tree ERROR_VARIABLE tree
                  RESULT_VARIABLE status)
  # Each node is one line, and the next line names its parent; the root is tu1. These signs would break CMake lists.
  string(REGEX REPLACE "[][;]" "" tree "${tree}")
  string(REGEX MATCHALL "label=\"[^\"|]+\\|[^\"]*\"\ntu1 -> " suites "${tree}")
  if(NOT status EQUAL 0 OR NOT suites)
    message(FATAL_ERROR "${tests_PROGRAM} lists no suites of tests:\n${tree}")
  endif()
  foreach(suite IN LISTS suites)
    string(REGEX REPLACE "^label=\"([^\"|]+)\\|.*" "\\1" name "${suite}")
    string(REGEX MATCHALL "@[A-Za-z0-9_]+" labels "${suite}")
    list(TRANSFORM labels REPLACE "^@" "")
    set(seconds 300)
    set(cost 0)
    if("slow" IN_LIST labels)
      set(seconds 1800)
      set(cost 1)
    endif()
    set(alone FALSE)
    set(environment ${tests_ENVIRONMENT} MALLOC_MMAP_THRESHOLD_=1073741824 MALLOC_TRIM_THRESHOLD_=1073741824
        OMP_WAIT_POLICY=passive)
    if("alone" IN_LIST labels)
      set(alone TRUE)
    elseif(NOT DEFINED ENV{OMP_NUM_THREADS})
      list(APPEND environment OMP_NUM_THREADS=1)
    endif()
    math(EXPR seconds "${seconds} * ${tests_SLOWER}")
    list(APPEND labels ${tests_LABELS})
    set(entries ${tests_MODULE}/${name})
    if(tests_OTHER_LIBRARIES AND NOT "fem" IN_LIST labels AND NOT "once" IN_LIST labels)
      list(APPEND entries other/${tests_MODULE}/${name})
    endif()
    foreach(entry IN LISTS entries)
      if(entry MATCHES "^other/")
        list(APPEND environment LD_LIBRARY_PATH=${tests_OTHER_LIBRARIES})
        list(APPEND labels other)
      endif()
      add_test(${entry} "${tests_PROGRAM}" --run_test=${name})
      set_tests_properties(${entry} PROPERTIES
                           LABELS "${labels}" TIMEOUT ${seconds} COST ${cost} RUN_SERIAL ${alone}
                           SKIP_REGULAR_EXPRESSION "Not tried: "
                           WORKING_DIRECTORY "${tests_FOLDER}" ENVIRONMENT "${environment}")
    endforeach()
  endforeach()
endfunction()
