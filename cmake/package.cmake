# SPDX-License-Identifier: Apache-2.0
# The renderer as one shared library for hosts outside of this build, and what `cmake --install`, `cpack` and `pip install .` put where.
#
#   PREFIX/lib/libpatina.so, include/patina, lib/cmake/Patina   for hosts in C++: find_package(Patina), Patina::patina
#   PREFIX/lib/glibc-hwcaps/LEVEL/libpatina.so                  the same for processors of a higher level: the loader takes the highest
#                                                               that the machine has (PATINA_LEVELS)
#   PREFIX/lib/patina/python, bin/patina                        the command; a wheel has it at its own root
#   PREFIX/plugin/usd                                           Hydra's plugin, where there is an OpenUSD
include(GNUInstallDirs)
option(PATINA_PACKAGE "Build what is installed: the shared library, which the Python module then uses" OFF)
set(PATINA_LEVELS "" CACHE STRING "Levels that the shared library is also built for, such as x86-64-v3;x86-64-v4")
if(SKBUILD)
    set(pythonFolder .)
    set(libraryFolder patina/lib)
    set(libraryFile libpatina.so) # a wheel holds no links
    set(libraryName libpatina.so)
else()
    set(pythonFolder lib/patina/python)
    set(libraryFolder ${CMAKE_INSTALL_LIBDIR})
    set(libraryFile libpatina.so.${PROJECT_VERSION})
    set(libraryName libpatina.so.${PROJECT_VERSION_MAJOR})
endif()

# All rooms but those of Hydra's hosts.
get_property(rooms GLOBAL PROPERTY PATINA_ROOMS)
list(REMOVE_ITEM rooms patinaHydra patinaHydraHost patinaHydraEdits)
foreach(room ${rooms})
    list(APPEND archives $<TARGET_FILE:${room}>)
endforeach()
if(PATINA_PACKAGE)
    add_library(patina SHARED cmake/package/library.cpp)
else()
    add_library(patina SHARED EXCLUDE_FROM_ALL cmake/package/library.cpp)
endif()
add_library(Patina::patina ALIAS patina)
target_link_options(patina PRIVATE -Wl,--whole-archive ${archives} -Wl,--no-whole-archive)
target_link_libraries(patina PRIVATE ${rooms})
target_include_directories(patina INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/patina>)
target_compile_features(patina INTERFACE cxx_std_17)
set_target_properties(patina PROPERTIES LINK_DEPENDS "${archives}" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
if(NOT SKBUILD)
    set_target_properties(patina PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
endif()
add_dependencies(patina ${rooms})

# The same library by level, each from a build of its own.
if(PATINA_PACKAGE AND PATINA_LEVELS)
    include(ExternalProject)
    # The launcher as it was given: patina.cmake makes a list of it. Lists keep together by another separator.
    string(REPLACE ";" "|" launcher "$CACHE{CMAKE_CXX_COMPILER_LAUNCHER}")
    string(REPLACE ";" "|" prefixes "${CMAKE_PREFIX_PATH}")
    foreach(level ${PATINA_LEVELS})
        set(folder ${CMAKE_BINARY_DIR}/levels/${level})
        ExternalProject_Add(patina-${level} SOURCE_DIR ${CMAKE_SOURCE_DIR} BINARY_DIR ${folder}
            CMAKE_ARGS -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
                       -DCMAKE_CXX_COMPILER_LAUNCHER=${launcher} -DCMAKE_PREFIX_PATH=${prefixes}
                       -DPATINA_BUILD_TESTS=OFF -DPATINA_NATIVE=OFF -DPATINA_LEVEL=${level} -DPATINA_LEVELS=
                       -DCMAKE_DISABLE_FIND_PACKAGE_pxr=ON -DPATINA_MODULE=OFF -DSKBUILD=${SKBUILD}
            BUILD_COMMAND ${CMAKE_COMMAND} --build ${folder} --target patina INSTALL_COMMAND "" BUILD_ALWAYS ON
            LIST_SEPARATOR "|")
        install(FILES ${folder}/lib/${libraryFile} DESTINATION ${libraryFolder}/glibc-hwcaps/${level} RENAME ${libraryName})
    endforeach()
endif()

if(TARGET hdPatina)
    file(RELATIVE_PATH fromPlugin /plugin/usd /${libraryFolder})
    set_property(TARGET hdPatina APPEND PROPERTY INSTALL_RPATH "$ORIGIN/${fromPlugin}")
endif()
install(TARGETS patina EXPORT patinaTargets LIBRARY DESTINATION ${libraryFolder} COMPONENT library)
install(TARGETS patinaTryImage RUNTIME DESTINATION ${libraryFolder}/patina)
if(TARGET patinaReadField) # beside the library that starts it, of whatever level
    install(TARGETS patinaReadField RUNTIME DESTINATION ${libraryFolder}/patina)
endif()

# Adds what a file includes, and what that includes.
function(_patina_included file found)
    file(STRINGS ${file} lines REGEX "^ *# *include \"")
    foreach(line ${lines})
        string(REGEX REPLACE "^[^\"]*\"([^\"]+)\".*" "\\1" name "${line}")
        if(NOT name IN_LIST ${found})
            list(APPEND ${found} ${name})
            _patina_included(${CMAKE_SOURCE_DIR}/${name} ${found})
        endif()
    endforeach()
    set(${found} ${${found}} PARENT_SCOPE)
endfunction()

if(NOT SKBUILD)
    install(FILES cmake/package/patina.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/patina)
    _patina_included(${CMAKE_SOURCE_DIR}/cmake/package/patina.h headers)
    foreach(header ${headers})
        get_filename_component(folder ${header} DIRECTORY)
        install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/patina/${folder})
    endforeach()
    set(configFolder ${CMAKE_INSTALL_LIBDIR}/cmake/Patina)
    include(CMakePackageConfigHelpers)
    configure_package_config_file(cmake/package/patinaConfig.cmake.in ${CMAKE_BINARY_DIR}/package/PatinaConfig.cmake
        INSTALL_DESTINATION ${configFolder})
    write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/PatinaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
    install(FILES ${CMAKE_BINARY_DIR}/package/PatinaConfig.cmake ${CMAKE_BINARY_DIR}/package/PatinaConfigVersion.cmake
        DESTINATION ${configFolder})
    install(EXPORT patinaTargets NAMESPACE Patina:: DESTINATION ${configFolder})
endif()

# The command: package, module, and the tables that both read.
if(TARGET _patina)
    file(RELATIVE_PATH toLibrary /${pythonFolder} /${libraryFolder})
    set_target_properties(_patina PROPERTIES INSTALL_RPATH "$ORIGIN/${toLibrary}")
    install(TARGETS _patina LIBRARY DESTINATION ${pythonFolder})
    install(FILES plugin/python/_patina.pyi DESTINATION ${pythonFolder})
    install(DIRECTORY plugin/patina DESTINATION ${pythonFolder}
        PATTERN tests EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN node_modules EXCLUDE)
    foreach(table hdDelegate/scene/settings.def hdDelegate/scene/primMarks.def
            hdDelegate/scene/cameraInputs.def hdDelegate/film/aovs.def
            base/limits.def base/messages.def)
        get_filename_component(folder ${table} DIRECTORY)
        install(FILES ${table} DESTINATION ${pythonFolder}/patina/tables/${folder})
    endforeach()
    install(DIRECTORY materialNetwork/library DESTINATION ${pythonFolder}/patina/tables/materialNetwork)
    # Where Node and npm are, the material page's script is made here, so that users need neither.
    find_package(Python3 COMPONENTS Interpreter)
    if(Python3_EXECUTABLE)
        set(script ${CMAKE_BINARY_DIR}/package/page.js)
        set(all "")
        if(PATINA_PACKAGE)
            set(all ALL)
        endif()
        add_custom_target(pageScript ${all} COMMENT "Bundling the material page's script" VERBATIM BYPRODUCTS ${script}
            COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${CMAKE_SOURCE_DIR}/plugin ${Python3_EXECUTABLE} -m patina.view.bundle ${script})
        install(FILES ${script} DESTINATION ${pythonFolder}/patina/view/web OPTIONAL)
    endif()
    if(NOT SKBUILD)
        file(RELATIVE_PATH toPython /${CMAKE_INSTALL_BINDIR} /${pythonFolder})
        configure_file(cmake/package/patina.in ${CMAKE_BINARY_DIR}/package/patina @ONLY)
        install(PROGRAMS ${CMAKE_BINARY_DIR}/package/patina DESTINATION ${CMAKE_INSTALL_BINDIR})
    endif()
endif()

set(CPACK_GENERATOR DEB TGZ)
if(TARGET hdPatina AND (NOT PATINA_PXR_CONFIG MATCHES "^/usr/" OR PATINA_PXR_CONFIG MATCHES "^/usr/local/")) # of this machine alone
    set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};${PROJECT_NAME};Unspecified;/;${CMAKE_BINARY_DIR};${PROJECT_NAME};library;/")
endif()
set(CPACK_PACKAGE_NAME hdpatina)
set(CPACK_PACKAGE_VENDOR Patina)
set(CPACK_PACKAGE_CONTACT "Patina <patina@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "USD Hydra render delegate and command line: path tracer and rasterizer of physically based materials")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy")
if(TARGET _patina) # a module is of one version of Python
    get_target_property(suffix _patina SUFFIX)
    if(suffix MATCHES "cpython-3([0-9]+)")
        math(EXPR next "${CMAKE_MATCH_1} + 1")
        set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.${CMAKE_MATCH_1}), python3 (<< 3.${next}), python3-numpy")
    endif()
endif()
# A Python environment that has usd-core; OpenGL in software, where there is no other; hosts in C++.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-venv, libgl1-mesa-dri, libglm-dev")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/package/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
include(CPack)
