# The project's own targets: options common to all, one static library a folder of src/, one test executable a folder
# of tests/.
add_library(spindrift_options INTERFACE)
target_compile_features(spindrift_options INTERFACE cxx_std_20)
target_include_directories(spindrift_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_definitions(spindrift_options INTERFACE SPINDRIFT_VERSION="${PROJECT_VERSION}"
                           $<$<BOOL:${SPINDRIFT_CHECKS}>:SPINDRIFT_CHECKS>)
# Neither flag changes a result; both let square roots and comparisons vectorise.
target_compile_options(spindrift_options INTERFACE -fno-math-errno -fno-trapping-math)
if(SPINDRIFT_NATIVE)
  target_compile_options(spindrift_options INTERFACE -march=native)
endif()
if(SPINDRIFT_STRICT)
  target_compile_options(spindrift_options INTERFACE -Wall -Wextra -Wconversion -Wshadow -Wpedantic -Werror)
endif()

# spindrift_library(name LINK public... PRIVATE private...)
function(spindrift_library name)
  cmake_parse_arguments(ARG "" "" "LINK;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC ${ARG_LINK} PRIVATE ${ARG_PRIVATE})
endfunction()

# spindrift_module(name): src/name/*.cpp with packages::name, where that is installed, as a library that io loads when it
# is first needed: src/io/module.hpp. All modules stand beside the program, at the top of the build folder.
set(CMAKE_BUILD_RPATH "$ORIGIN" "$ORIGIN/..")  # the second for the tests
function(spindrift_module name)
  if(NOT TARGET packages::${name})
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  add_library(module_${name} MODULE ${sources})
  target_link_libraries(module_${name} PRIVATE spindrift_options packages::fmt packages::${name})
  target_link_options(module_${name} PRIVATE LINKER:--no-undefined)
  set_target_properties(module_${name} PROPERTIES PREFIX "" OUTPUT_NAME spindrift_${name}
                        LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  string(TOUPPER ${name} package)
  target_compile_definitions(io PRIVATE SPINDRIFT_${package})
  add_dependencies(io module_${name})
endfunction()

# spindrift_tests(name LINK libraries...): tests/name/*.cpp as the executable test_name.
# Cases tagged [slow] run in a test of their own, so that `ctest -LE slow` stays fast.
function(spindrift_tests name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE ${ARG_LINK} test_main)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(test_${name} PRIVATE SPINDRIFT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                             SPINDRIFT_BINARY_DIR="${PROJECT_BINARY_DIR}")
  add_test(NAME ${name} COMMAND test_${name} "~[slow]")
  add_test(NAME ${name}_slow COMMAND test_${name} "[slow]")
  set_tests_properties(${name}_slow PROPERTIES LABELS slow)
endfunction()
