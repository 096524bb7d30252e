# SPDX-License-Identifier: Apache-2.0
# Finds OpenSubdiv's CPU library and defines OpenSubdiv::osdCPU.
find_path(OpenSubdiv_INCLUDE_DIR NAMES opensubdiv/version.h)
find_library(OpenSubdiv_LIBRARY NAMES osdCPU)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdiv REQUIRED_VARS OpenSubdiv_LIBRARY OpenSubdiv_INCLUDE_DIR)
if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
    add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
    set_target_properties(OpenSubdiv::osdCPU PROPERTIES
        IMPORTED_LOCATION ${OpenSubdiv_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenSubdiv_INCLUDE_DIR})
endif()
