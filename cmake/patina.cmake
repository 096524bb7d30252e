# SPDX-License-Identifier: Apache-2.0
# Helpers that give every room the same flags.

function(_patina_flags target)
    target_include_directories(${target} PUBLIC ${CMAKE_SOURCE_DIR})
    # Products and sums stay apart, so that every processor computes the same bits, and so does every spelling of a formula.
    target_compile_options(${target} PRIVATE -Wall -Wextra -fno-math-errno -ffp-contract=off -fvisibility-inlines-hidden)
    if(PATINA_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(PATINA_NATIVE)
        target_compile_options(${target} PRIVATE -march=native)
    elseif(PATINA_LEVEL)
        target_compile_options(${target} PRIVATE -march=${PATINA_LEVEL})
    endif()
    if(PATINA_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${PATINA_SANITIZE} -fno-omit-frame-pointer)
        target_link_options(${target} PUBLIC -fsanitize=${PATINA_SANITIZE})
        if(PATINA_SANITIZE STREQUAL "thread")
            # TBB is not instrumented; see hdDelegate/parallel.h.
            target_compile_definitions(${target} PUBLIC PATINA_PLAIN_THREADS)
            # OpenUSD's reference counts use fences, which ThreadSanitizer does not know.
            target_compile_options(${target} PRIVATE -Wno-tsan)
        endif()
    endif()
endfunction()

# Headers of other projects that most files include are compiled once for the libraries, and once for the tests, which are
# programs and include googletest. They are named by no path, so that checkouts share them in ccache's cache.
if(PATINA_PRECOMPILED)
    if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache$" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # Else ccache keeps nothing that a precompiled header is part of.
        set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CMAKE_CXX_COMPILER_LAUNCHER})
        add_compile_options(-fpch-preprocess)
    endif()
    add_library(patinaPrecompiled OBJECT ${CMAKE_SOURCE_DIR}/cmake/precompiled/library.cpp)
    target_precompile_headers(patinaPrecompiled PRIVATE <cmake/precompiled/precompiled.h>)
    _patina_flags(patinaPrecompiled)
    if(PATINA_BUILD_TESTS)
        add_executable(patinaTestsPrecompiled ${CMAKE_SOURCE_DIR}/cmake/precompiled/program.cpp)
        target_precompile_headers(patinaTestsPrecompiled PRIVATE <cmake/precompiled/forTests.h>)
        target_link_libraries(patinaTestsPrecompiled PRIVATE GTest::gtest)
        _patina_flags(patinaTestsPrecompiled)
    endif()
endif()

# patina_unity(targets...): their files are compiled six at once, since headers take most of the time of each.
# Names in anonymous namespaces have to differ within a target.
function(patina_unity)
    foreach(target ${ARGN})
        if(PATINA_UNITY AND TARGET ${target})
            set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
            # g++ takes the files for headers, in which it would be a mistake.
            target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
        endif()
    endforeach()
endfunction()

# patina_add_library(name SOURCES... [LIBS libraries...]): a static library of one room.
function(patina_add_library name)
    cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
    add_library(${name} STATIC ${arg_UNPARSED_ARGUMENTS})
    target_link_libraries(${name} PUBLIC ${arg_LIBS})
    _patina_flags(${name})
    set_property(GLOBAL APPEND PROPERTY PATINA_ROOMS ${name}) # see package.cmake
    if(PATINA_PRECOMPILED)
        target_precompile_headers(${name} REUSE_FROM patinaPrecompiled)
    endif()
endfunction()

# patina_add_test(name SOURCES... LIBS libraries...): a googletest program in <build>/tests, where
# the test runner collects every program. NAME.folder beside it names the folder that it tests.
function(patina_add_test name)
    if(NOT PATINA_BUILD_TESTS)
        return()
    endif()
    cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
    add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
    target_link_libraries(${name} PRIVATE ${arg_LIBS} GTest::gtest_main)
    _patina_flags(${name})
    if(PATINA_PRECOMPILED)
        target_precompile_headers(${name} REUSE_FROM patinaTestsPrecompiled)
    endif()
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
    file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/tests/${name}.folder CONTENT "${folder}\n")
    add_test(NAME ${name} COMMAND ${name})
endfunction()
