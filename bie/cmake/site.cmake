# One site from the pages of docs/, the files of the top folder, the docstrings of the module of Python and the headers of
# both halves, in SITE, which is made anew:
#   cmake -DSITE=build/site -P bie/cmake/site.cmake
# A warning of Sphinx or doxygen is an error, and so is a link that leads nowhere. With -DOPTIONAL=ON it is made only where its tools are there.
cmake_minimum_required(VERSION 3.25)

get_filename_component(source "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
get_filename_component(site "${SITE}" ABSOLUTE)
include("${CMAKE_CURRENT_LIST_DIR}/site_tools.cmake")
if(missing_site_tools)
  list(JOIN missing_site_tools " " names)
  if(OPTIONAL)
    message("No site: these Debian packages are not installed: ${names}")
    return()
  endif()
  message(FATAL_ERROR "a site needs the Debian packages ${names}")
endif()

# Links lead from page to page as they do in the project, so the copy has its folders.
set(pages "${site}-pages")
file(REMOVE_RECURSE "${site}" "${pages}")
file(GLOB files "${source}/*.md")
file(COPY ${files} "${source}/docs" DESTINATION "${pages}")
file(COPY "${source}/bie/python/vehd" DESTINATION "${pages}/python_module")

get_filename_component(mathjax "${mathjax}" DIRECTORY)
foreach(part IN ITEMS MathJax.js config/TeX-AMS_SVG.js extensions jax/element jax/input/TeX jax/output/SVG)
  get_filename_component(folder "${part}" DIRECTORY)
  file(COPY "${mathjax}/${part}" DESTINATION "${pages}/docs/site/mathjax/${folder}" FOLLOW_SYMLINK_CHAIN
       PATTERN fonts EXCLUDE)
endforeach()
file(COPY "${mathjax}/jax/output/SVG/fonts/TeX" DESTINATION "${pages}/docs/site/mathjax/jax/output/SVG/fonts")

# Executed notebooks with their figures, where the module of Python is built and has what they need.
get_filename_component(build "${site}" DIRECTORY)
execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${build}/python" OMP_NUM_THREADS=1
                        ${python} "${source}/docs/notebooks/editions.py" --html "${pages}/notebooks_html"
                RESULT_VARIABLE not_executed)
if(NOT not_executed EQUAL 0 AND NOT not_executed EQUAL 77)
  message(FATAL_ERROR "a notebook fails")
endif()

execute_process(COMMAND "${sphinx}" -q -W --keep-going -b html -c "${pages}/docs/site" "${pages}" "${site}"
                WORKING_DIRECTORY "${source}" COMMAND_ERROR_IS_FATAL ANY)

if(not_executed EQUAL 0)
  file(GLOB notebooks "${pages}/notebooks_html/*.html")
  file(COPY ${notebooks} DESTINATION "${site}/docs/notebooks")
endif()

file(READ "${source}/docs/site/Doxyfile" settings)
string(APPEND settings "INPUT = \"${source}/bie\" \"${source}/fem_check\" \"${source}/meshes\"\n"
       "STRIP_FROM_PATH = \"${source}\"\nOUTPUT_DIRECTORY = \"${site}\"\n")
file(WRITE "${pages}/Doxyfile" "${settings}")
execute_process(COMMAND "${doxygen}" "${pages}/Doxyfile" WORKING_DIRECTORY "${source}" COMMAND_ERROR_IS_FATAL ANY)

file(WRITE "${site}/index.html" "<!doctype html><meta http-equiv=\"refresh\" content=\"0; url=docs/index.html\">\n")
file(REMOVE_RECURSE "${pages}")
execute_process(COMMAND ${python} "${source}/docs/site/check_links.py" "${site}" COMMAND_ERROR_IS_FATAL ANY)
message("The site begins at ${site}/index.html")
