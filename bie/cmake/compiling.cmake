# vehd_flags holds the options on which all code that includes a header of vehd must agree. vehd_compilation holds the
# options for vehd's own code; installed targets do not pass them on.
add_library(vehd_flags INTERFACE)
target_include_directories(vehd_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/vehd>)
target_compile_features(vehd_flags INTERFACE cxx_std_20)
# Only vehd's own loops are parallel: Eigen's parallelism would change the order of sums with the number of threads. Memory
# has the alignment of the widest instruction set, so that code compiled for different sets can share matrices.
target_compile_definitions(vehd_flags INTERFACE EIGEN_DONT_PARALLELIZE EIGEN_MAX_ALIGN_BYTES=64)
target_link_libraries(vehd_flags INTERFACE Eigen3::Eigen fmt::fmt OpenMP::OpenMP_CXX)

add_library(vehd_compilation INTERFACE)
target_compile_options(vehd_compilation INTERFACE -Wall -Wextra -Wshadow -fno-math-errno -fno-trapping-math)
# GCC 12 warns of uninitialised registers inside its own AVX-512 headers.
target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
                                                  -Wno-uninitialized)
# GCC collects its garbage only above a gigabyte: with its default limit it spends a seventh of its time on this.
target_compile_options(vehd_compilation INTERFACE "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1000000>")
if(CMAKE_UNITY_BUILD)
  # A unity build includes each file in another: its internal types then seem to be in a header, and its names may shadow
  # those of its neighbours.
  target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>
                                                    $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>)
endif()
# Without optimisation clang warns of every loop that it does not vectorise.
target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>)
if(VEHD_CCACHE)
  target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                                                    "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
if(architecture)
  # Targets that are built for several instruction sets name theirs in the property VEHD_LEVEL.
  set(level $<TARGET_PROPERTY:VEHD_LEVEL>)
  target_compile_options(vehd_compilation INTERFACE -march=$<IF:$<BOOL:${level}>,${level},${architecture}>)
endif()
# Options for code whose own running time does not matter.
set(quickly_compiled)
if(BUILD_SHARED_LIBS)
  # A library calls its own functions, which no other library replaces, and keeps its own instances of templates, because
  # other libraries may have been compiled with other options.
  set(quickly_compiled $<$<CONFIG:Release>:-O1>)
  target_compile_options(vehd_compilation INTERFACE -fvisibility-inlines-hidden -fno-semantic-interposition)
  add_link_options(-Wl,-Bsymbolic -Wl,--enable-new-dtags)
endif()
# Other libraries (Debian's gmsh contains Eigen) align matrices differently, and so free them differently: functions that the
# compiler does not inline here must not replace theirs.
add_link_options(-Wl,--version-script=${CMAKE_CURRENT_LIST_DIR}/own_templates.map)
if(VEHD_SANITIZE)
  target_compile_options(vehd_compilation INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/undefined_elsewhere.txt>)
  target_link_options(vehd_compilation INTERFACE -fsanitize=address,undefined)
endif()
if(VEHD_FUZZ)
  target_compile_options(vehd_compilation INTERFACE -fsanitize=fuzzer-no-link)
endif()
