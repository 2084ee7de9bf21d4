# vehd_flags: what everything that includes a header of vehd has to agree on. vehd_compilation: how vehd itself is
# compiled; nobody else inherits it.
add_library(vehd_flags INTERFACE)
target_include_directories(vehd_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/vehd>)
target_compile_features(vehd_flags INTERFACE cxx_std_20)
# Parallelism is explicit in vehd's own loops: Eigen's would change the order of sums with the thread count. Memory is
# aligned as the widest instruction set needs it, so that parts compiled for different ones can share matrices.
target_compile_definitions(vehd_flags INTERFACE EIGEN_DONT_PARALLELIZE EIGEN_MAX_ALIGN_BYTES=64)
target_link_libraries(vehd_flags INTERFACE Eigen3::Eigen fmt::fmt OpenMP::OpenMP_CXX)

add_library(vehd_compilation INTERFACE)
target_compile_options(vehd_compilation INTERFACE -Wall -Wextra -Wshadow -fno-math-errno -fno-trapping-math)
# GCC 12 sees uninitialised registers inside its own AVX-512 headers.
target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
                                                  -Wno-uninitialized)
# It collects its garbage at a gigabyte: at its own limit it spends a seventh of its time on that.
target_compile_options(vehd_compilation INTERFACE "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1000000>")
if(CMAKE_UNITY_BUILD)
  # Every file is then included by another, whose names are not seen by others either, and meets those of its neighbours.
  target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>
                                                    $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>)
endif()
# Without optimisation clang says so of every loop that it leaves as it is.
target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>)
if(VEHD_CCACHE)
  target_compile_options(vehd_compilation INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                                                    "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
if(architecture)
  # The property is that of the target which is compiled: set for what is built for several instruction sets.
  set(level $<TARGET_PROPERTY:VEHD_LEVEL>)
  target_compile_options(vehd_compilation INTERFACE -march=$<IF:$<BOOL:${level}>,${level},${architecture}>)
endif()
# What takes no time by itself.
set(quickly_compiled)
if(BUILD_SHARED_LIBS)
  # A library calls its own functions, which nobody replaces, and keeps its own instance of a template, which may be
  # compiled otherwise than others'.
  set(quickly_compiled $<$<CONFIG:Release>:-O1>)
  target_compile_options(vehd_compilation INTERFACE -fvisibility-inlines-hidden -fno-semantic-interposition)
  add_link_options(-Wl,-Bsymbolic -Wl,--enable-new-dtags)
endif()
# Matrices of other libraries (Debian's gmsh has Eigen inside) are aligned, and so freed, otherwise: what the compiler
# leaves out of line here must not take the place of theirs.
add_link_options(-Wl,--version-script=${CMAKE_CURRENT_LIST_DIR}/own_templates.map)
if(VEHD_SANITIZE)
  target_compile_options(vehd_compilation INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/undefined_elsewhere.txt>)
  target_link_options(vehd_compilation INTERFACE -fsanitize=address,undefined)
endif()
if(VEHD_FUZZ)
  target_compile_options(vehd_compilation INTERFACE -fsanitize=fuzzer-no-link)
endif()
