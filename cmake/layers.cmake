# cca_layer(NAME SOURCES file... [DEPENDS target...] PRECOMPILED header...|PRECOMPILED_BY layer)
#
# One folder of src/, or of benchmarks/, as a library cca_NAME, known as cca_mrpt::NAME here and to projects that
# find_package(cca_mrpt). A layer may use only the layers named in DEPENDS. PRECOMPILED are big headers
# of others that most of its files need, compiled once for all, or what another layer has of them; each
# file includes what it needs all the same.
function(cca_layer name)
  cmake_parse_arguments(ARG "" "PRECOMPILED_BY" "SOURCES;DEPENDS;PRIVATE_DEPENDS;PRECOMPILED" ${ARGN})
  set(target cca_${name})
  add_library(${target} ${ARG_SOURCES})
  add_library(cca_mrpt::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON
                        DEFINE_SYMBOL "")  # else no layer could share precompiled headers with another
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${cca_mrpt_SOURCE_DIR}/include> $<BUILD_INTERFACE:${cca_mrpt_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_link_libraries(${target} PUBLIC Eigen3::Eigen ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
  if(ARG_PRECOMPILED)
    target_precompile_headers(${target} PRIVATE ${ARG_PRECOMPILED})
  else()
    target_precompile_headers(${target} REUSE_FROM cca_${ARG_PRECOMPILED_BY})
  endif()
  cca_options(${target})
  cca_join_sources(${target})
endfunction()

# cca_add_replay_template(TARGET): the page of replay.html, libraries and all, stands in the program.
function(cca_add_replay_template target)
  set(replay ${PROJECT_SOURCE_DIR}/src/io/replay)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/replay_template.hpp)
  file(GLOB_RECURSE parts CONFIGURE_DEPENDS ${replay}/page/*)
  add_custom_command(OUTPUT ${header}
    COMMAND ${CMAKE_COMMAND} -D SOURCES=${replay}/page -D OUT=${header}
            -P ${PROJECT_SOURCE_DIR}/cmake/replay_template.cmake
    DEPENDS ${parts} ${PROJECT_SOURCE_DIR}/cmake/replay_template.cmake VERBATIM)
  target_sources(${target} PRIVATE ${header})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()

# cca_late_library(NAME SOURCES file... DEPENDS target...)
#
# A library libcca_NAME.so that no target links: lateFunction() loads it, from where cca_io lies.
function(cca_late_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  set(target cca_${name})
  add_library(${target} MODULE ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE ${ARG_DEPENDS})
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY $<TARGET_FILE_DIR:cca_io>)
  cca_options(${target})
  add_dependencies(cca_late_libraries ${target})
  #catkin_lint: ignore_once wrong_install_destination
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()
add_custom_target(cca_late_libraries)

# All sources of a target are compiled as one: what they instantiate of Eigen, MRPT and ROS takes longer than they
# do. So no two files of a layer may give one name to different things in their anonymous namespaces, in whatever
# order they stand: the compiler says so. -DCCA_EACH_FILE_ALONE=ON compiles each by itself: longer from nothing,
# shorter after a change.
function(cca_join_sources target)
  if(NOT CCA_EACH_FILE_ALONE)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
endfunction()

# What all is compiled with, tests too.
function(cca_common_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow)
  # Calls inside a shared library stay inside it, and so can be inlined: 5 % fewer instructions.
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  if(CCA_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# The same and sanitizers, of libraries and programs. Sanitized tests would take as long to compile as all that they
# test.
function(cca_options target)
  cca_common_options(${target})
  if(CCA_SANITIZE)
    # Checks of the value of each pointer take a third of the time to compile, and find what the address sanitizer
    # reports where the pointer is used. Alignment is asked for by Eigen alone, which asserts it.
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                           -fno-sanitize=null,alignment,pointer-overflow -fno-omit-frame-pointer)
    # A library calls its own instances of templates, which are checked, and not those of a test, which are not.
    target_link_options(${target} PUBLIC -fsanitize=address,undefined PRIVATE -Wl,-Bsymbolic-functions)
    if(CCA_BUILD_FUZZERS)
      target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    endif()
  endif()
endfunction()
