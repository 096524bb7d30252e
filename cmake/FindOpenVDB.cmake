# SPDX-License-Identifier: Apache-2.0
# OpenVDB::openvdb, where there is one. (OpenVDB's own module wants versions of its dependencies that
# it was not built with on some systems.)
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OpenVDB_LIBRARY openvdb)
find_package(Imath CONFIG QUIET)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR)
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
    add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
    set_target_properties(OpenVDB::openvdb PROPERTIES
        IMPORTED_LOCATION ${OpenVDB_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenVDB_INCLUDE_DIR})
    target_link_libraries(OpenVDB::openvdb INTERFACE TBB::tbb)
    if(TARGET Imath::Imath)
        target_link_libraries(OpenVDB::openvdb INTERFACE Imath::Imath)
    endif()
endif()
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_LIBRARY)
