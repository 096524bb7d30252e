# SPDX-License-Identifier: Apache-2.0
# Finds OpenImageIO and defines OpenImageIO::OpenImageIO. Debian 12's own package file names the
# headers of OpenCV, which it does not require, and so stops CMake.
find_path(OpenImageIO_INCLUDE_DIR NAMES OpenImageIO/imageio.h)
find_library(OpenImageIO_LIBRARY NAMES OpenImageIO)
find_library(OpenImageIO_Util_LIBRARY NAMES OpenImageIO_Util)
find_package(Imath CONFIG REQUIRED) # its headers are part of OpenImageIO's
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO REQUIRED_VARS
    OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY OpenImageIO_INCLUDE_DIR)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
    add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
    set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
        IMPORTED_LOCATION ${OpenImageIO_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenImageIO_INCLUDE_DIR}
        INTERFACE_LINK_LIBRARIES "${OpenImageIO_Util_LIBRARY};Imath::Imath")
endif()
