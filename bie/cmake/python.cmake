# The module of Python in build/python/vehd: its compiled part and its Python files are in one folder, as when installed. No
# other code uses pybind11.
set(python_source ${PROJECT_SOURCE_DIR}/bie/python)
set(python_package ${CMAKE_BINARY_DIR}/python/vehd)
# Debian's python3 searches this folder below /usr.
set(VEHD_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Where the module of Python is installed")

file(GLOB sources CONFIGURE_DEPENDS ${python_source}/*.cpp)
pybind11_add_module(vehd_python MODULE NO_EXTRAS ${sources})
target_link_libraries(vehd_python PRIVATE vehd_bench vehd_fit vehd_compilation)
target_compile_options(vehd_python PRIVATE ${quickly_compiled})
# The module finds the libraries relative to its own folder.
file(RELATIVE_PATH to_libraries /${VEHD_PYTHON_FOLDER}/vehd /${library_folder})
set_target_properties(vehd_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${python_package}
                                             INSTALL_RPATH "$ORIGIN/${to_libraries}")

file(GLOB texts CONFIGURE_DEPENDS ${python_source}/vehd/*.py ${python_source}/vehd/*.pyi ${python_source}/vehd/py.typed)
set(copies)
foreach(text IN LISTS texts)
  get_filename_component(name ${text} NAME)
  add_custom_command(OUTPUT ${python_package}/${name}
                     COMMAND ${CMAKE_COMMAND} -E copy ${text} ${python_package}/${name}
                     DEPENDS ${text} VERBATIM)
  list(APPEND copies ${python_package}/${name})
endforeach()
add_custom_target(vehd_python_texts ALL DEPENDS ${copies})
add_dependencies(vehd_python vehd_python_texts)

# Runs Example 1 of the paper, the last action of bie/setup.cmake with -DSTEP=python.
add_custom_target(vehd_python_example
                  COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${CMAKE_BINARY_DIR}/python ${Python3_EXECUTABLE} -m vehd
                  DEPENDS vehd_python USES_TERMINAL VERBATIM)

install(TARGETS vehd_python LIBRARY DESTINATION ${VEHD_PYTHON_FOLDER}/vehd)
install(FILES ${texts} DESTINATION ${VEHD_PYTHON_FOLDER}/vehd)
