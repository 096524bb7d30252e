# SPDX-License-Identifier: Apache-2.0
# Looks for an OpenUSD with Hydra: in PXR_USD_LOCATION, pxr_DIR, CMAKE_PREFIX_PATH and /usr/local/USD.
# Hydra is a host like any other: without it the build says so in one line and goes on.
# Sets PATINA_HAS_HYDRA, PATINA_PXR_ROOT and PATINA_PXR_LIBRARIES.
set(PATINA_HAS_HYDRA OFF)
if(PATINA_PXR_CONFIG AND NOT EXISTS "${PATINA_PXR_CONFIG}")
    unset(PATINA_PXR_CONFIG CACHE) # an OpenUSD that was removed since the last configuration
endif()
if(DEFINED ENV{PXR_USD_LOCATION} AND NOT PATINA_PXR_ASKED STREQUAL "$ENV{PXR_USD_LOCATION}")
    unset(PATINA_PXR_CONFIG CACHE) # another one than the last configuration's
    set(PATINA_PXR_ASKED "$ENV{PXR_USD_LOCATION}" CACHE INTERNAL "OpenUSD that was asked for")
endif()
find_file(PATINA_PXR_CONFIG pxrConfig.cmake
    HINTS ${pxr_DIR} ${PXR_USD_LOCATION} $ENV{PXR_USD_LOCATION} $ENV{pxr_DIR}
    PATHS /usr/local/USD PATH_SUFFIXES . lib/cmake/pxr cmake)
if(CMAKE_DISABLE_FIND_PACKAGE_pxr OR NOT PATINA_PXR_CONFIG)
    message(STATUS "OpenUSD with Hydra not found: stages are read through the pxr Python module, the Hydra plugin is not built")
    file(GLOB stale ${CMAKE_BINARY_DIR}/usdPlugin ${CMAKE_BINARY_DIR}/tests/hydra* ${CMAKE_BINARY_DIR}/tests/testHydra*)
    if(stale)
        file(REMOVE_RECURSE ${stale}) # built with an OpenUSD that was removed since
    endif()
    return()
endif()

get_filename_component(PATINA_PXR_ROOT ${PATINA_PXR_CONFIG} REALPATH)
get_filename_component(PATINA_PXR_ROOT ${PATINA_PXR_ROOT} DIRECTORY)

# Its configuration asks for the very Python that it was built with, which need not be ours and
# which CMake finds only when it is told where headers and library are.
set(PATINA_PXR_PYTHON "")
set(pythonHints "")
file(STRINGS ${PATINA_PXR_CONFIG} line REGEX "set\\(Python3_EXECUTABLE")
if(line MATCHES "\\[\\[(.+)\\]\\]")
    set(PATINA_PXR_PYTHON ${CMAKE_MATCH_1})
endif()
if(EXISTS "${PATINA_PXR_PYTHON}")
    execute_process(
        COMMAND ${PATINA_PXR_PYTHON} -c
                "import sysconfig as s; v=s.get_config_var; print(s.get_path('include') + ';' + v('LIBDIR') + '/' + v('LDLIBRARY'))"
        OUTPUT_VARIABLE paths OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    list(LENGTH paths count)
    if(count EQUAL 2)
        list(GET paths 0 pythonInclude)
        list(GET paths 1 pythonLibrary)
        if(EXISTS ${pythonInclude}/Python.h AND EXISTS ${pythonLibrary})
            set(pythonHints -DPython3_INCLUDE_DIR=${pythonInclude} -DPython3_LIBRARY=${pythonLibrary})
        endif()
    endif()
endif()

if(NOT PATINA_PXR_PROBED STREQUAL PATINA_PXR_ROOT)
    execute_process(
        COMMAND ${CMAKE_COMMAND} -S ${CMAKE_SOURCE_DIR}/cmake/probeOpenUSD
                -B ${CMAKE_BINARY_DIR}/probeOpenUSD -G ${CMAKE_GENERATOR} -Dpxr_DIR=${PATINA_PXR_ROOT}
                -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} ${pythonHints}
        RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(failed)
        string(REGEX REPLACE ".*CMake Error[^\n]*\n" "" reason "${output}")
        string(REGEX REPLACE "[ \n]+" " " reason "${reason}")
        string(SUBSTRING "${reason}" 0 200 reason)
        message(STATUS "OpenUSD in ${PATINA_PXR_ROOT} cannot be used, the Hydra plugin is not built: ${reason}")
        return()
    endif()
    set(PATINA_PXR_PROBED ${PATINA_PXR_ROOT} CACHE INTERNAL "OpenUSD that can be used")
endif()

set(ownPython "${Python3_EXECUTABLE}")
unset(Python3_EXECUTABLE CACHE)
unset(Python3_EXECUTABLE)
if(pythonHints)
    set(Python3_INCLUDE_DIR ${pythonInclude})
    set(Python3_LIBRARY ${pythonLibrary})
endif()
set(pxr_DIR ${PATINA_PXR_ROOT})
find_package(pxr CONFIG QUIET REQUIRED)
foreach(name EXECUTABLE INCLUDE_DIR LIBRARY)
    unset(Python3_${name})
    unset(Python3_${name} CACHE)
endforeach()
if(ownPython)
    set(Python3_EXECUTABLE "${ownPython}" CACHE FILEPATH "Python that patina runs in" FORCE)
endif()

if(TARGET hd AND NOT TARGET usdImaging)
    message(STATUS "OpenUSD in ${PATINA_PXR_ROOT} has no UsdImaging, the Hydra plugin is not built")
    return()
endif()
if(TARGET hd)
    set(PATINA_PXR_LIBRARIES hd hdsi hgi sdr usdImaging)
    foreach(name ndr usdLod) # merged into sdr by OpenUSD 25.08, new in 26.08
        if(TARGET ${name})
            list(APPEND PATINA_PXR_LIBRARIES ${name})
        endif()
    endforeach()
elseif(TARGET usd_ms)
    set(PATINA_PXR_LIBRARIES usd_ms)
else()
    set(PATINA_PXR_LIBRARIES usd_m)
endif()
set(PATINA_HAS_HYDRA ON)
message(STATUS "OpenUSD ${PXR_VERSION} in ${PATINA_PXR_ROOT}: the Hydra plugin is built")
