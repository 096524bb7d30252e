# SPDX-License-Identifier: Apache-2.0
# Finds EGL with the headers of OpenGL's core profile and defines EGL::EGL. OpenGL itself is loaded
# through EGL, so its library is not linked.
find_path(EGL_INCLUDE_DIR EGL/egl.h)
find_path(EGL_GL_INCLUDE_DIR GL/glcorearb.h)
find_library(EGL_LIBRARY EGL)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(EGL REQUIRED_VARS EGL_LIBRARY EGL_INCLUDE_DIR EGL_GL_INCLUDE_DIR)
if(EGL_FOUND AND NOT TARGET EGL::EGL)
    add_library(EGL::EGL UNKNOWN IMPORTED)
    set_target_properties(EGL::EGL PROPERTIES
        IMPORTED_LOCATION ${EGL_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES "${EGL_INCLUDE_DIR};${EGL_GL_INCLUDE_DIR}")
endif()
mark_as_advanced(EGL_INCLUDE_DIR EGL_GL_INCLUDE_DIR EGL_LIBRARY)
