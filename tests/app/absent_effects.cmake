# A scene without electricity must not run a single instruction of electric, charging or Laplace code, and deciding what
# a run needs must cost under 0.1% of it. Counted by callgrind:
#   cmake -DPROGRAM=vehd -DFOLDER=work -P absent_effects.cmake
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
file(WRITE "${FOLDER}/scene.toml" [=[
[shape]
kind = "ellipsoid"
axes = [1.5, 1.0, 1.0]
[membrane]
bending_modulus = 0.1
[flow]
kind = "shear"
rate = 1.0
[numerics]
order = 8
dt = 0.1
end_time = 1.0
]=])
execute_process(
  COMMAND "${CMAKE_COMMAND}" -E env OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive valgrind --tool=callgrind
          "--callgrind-out-file=${FOLDER}/calls" "${PROGRAM}" run "${FOLDER}/scene.toml" -o "${FOLDER}/out" --no-plot
  OUTPUT_QUIET ERROR_VARIABLE messages RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "valgrind: ${messages}")
endif()
execute_process(COMMAND callgrind_annotate --inclusive=yes --threshold=100 "${FOLDER}/calls" OUTPUT_FILE
                "${FOLDER}/functions" RESULT_VARIABLE status ERROR_QUIET)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "callgrind_annotate failed (${status})")
endif()

# Lines: instructions (share) file:function [object]
set(line_start "^ *([0-9,]+) \\( *[0-9.]+%\\) +[^ ]*:")
file(STRINGS "${FOLDER}/functions" total REGEX "PROGRAM TOTALS")
string(REGEX REPLACE "^ *([0-9,]+).*" "\\1" total "${total}")
string(REPLACE "," "" total "${total}")

# The scene's own structs and keys are called electric as well; they are read, not run.
file(STRINGS "${FOLDER}/functions" electric
     REGEX "${line_start}vehd::[A-Za-z_:]*(electric_|charge|charging|hypersingular|second_kind|solve_laws|steady_potential|laplace)")
if(electric)
  list(JOIN electric "\n" electric)
  message(FATAL_ERROR "electric code ran in a scene without electricity:\n${electric}")
endif()

set(bookkeeping 0)
foreach(name find_frame find_symmetry model_of needed_layers next_discontinuity jumps_at plan_step)
  file(STRINGS "${FOLDER}/functions" lines REGEX "${line_start}vehd::${name}\\(")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "${line_start}.*" "\\1" count "${line}")
    string(REPLACE "," "" count "${count}")
    math(EXPR bookkeeping "${bookkeeping} + ${count}")
  endforeach()
endforeach()
if(bookkeeping EQUAL 0)
  message(FATAL_ERROR "no bookkeeping was found: its functions have other names")
endif()
math(EXPR millionths "1000000 * ${bookkeeping} / ${total}")
message(STATUS "electric code: 0 of ${total} instructions; bookkeeping: ${bookkeeping}, ${millionths} millionths")
if(millionths GREATER 1000)
  message(FATAL_ERROR "bookkeeping takes more than 0.1%")
endif()
