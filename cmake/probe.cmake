# SPDX-License-Identifier: Apache-2.0
# patina_probe(NAME SOURCE WITHOUT LIBS targets...): compiles and links SOURCE, which includes what the project includes of
# an optional library. Unsets NAME_FOUND where that fails, and says in one line what is left out (WITHOUT) and why.
# A success is remembered; after a failure the next configuration tries again, since a package may have been installed.
function(patina_probe name source without)
    cmake_parse_arguments(arg "" "" "LIBS" ${ARGN})
    if(NOT ${name}_FOUND)
        message(STATUS "Left out: ${without} (${name} is not there)")
        return()
    endif()
    if(PATINA_${name}_COMPILES)
        return()
    endif()
    unset(PATINA_${name}_COMPILES CACHE)
    try_compile(PATINA_${name}_COMPILES ${CMAKE_BINARY_DIR}/probes/${name} ${source}
        LINK_LIBRARIES ${arg_LIBS} OUTPUT_VARIABLE output CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
    if(PATINA_${name}_COMPILES)
        return()
    endif()
    set(${name}_FOUND OFF PARENT_SCOPE)
    set(reason "no reason was given")
    if(output MATCHES "((fatal )?error:[^\n]*|undefined reference[^\n]*)")
        set(reason "${CMAKE_MATCH_1}")
    endif()
    message(STATUS "Left out: ${without} (${name} does not compile: ${reason})")
endfunction()
