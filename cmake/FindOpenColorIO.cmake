# SPDX-License-Identifier: Apache-2.0
# Finds OpenColorIO, of which Debian 12 installs no CMake package, and defines
# OpenColorIO::OpenColorIO.
find_path(OpenColorIO_INCLUDE_DIR NAMES OpenColorIO/OpenColorIO.h)
find_library(OpenColorIO_LIBRARY NAMES OpenColorIO)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenColorIO REQUIRED_VARS OpenColorIO_LIBRARY OpenColorIO_INCLUDE_DIR)
if(OpenColorIO_FOUND AND NOT TARGET OpenColorIO::OpenColorIO)
    add_library(OpenColorIO::OpenColorIO UNKNOWN IMPORTED)
    set_target_properties(OpenColorIO::OpenColorIO PROPERTIES
        IMPORTED_LOCATION ${OpenColorIO_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenColorIO_INCLUDE_DIR})
endif()
