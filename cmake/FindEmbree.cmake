# SPDX-License-Identifier: Apache-2.0
# Finds Embree 4 or 3 and defines Embree::embree; PATINA_EMBREE_MAJOR says which it is.
find_path(Embree_INCLUDE_DIR NAMES embree4/rtcore.h embree3/rtcore.h)
if(Embree_INCLUDE_DIR AND EXISTS ${Embree_INCLUDE_DIR}/embree4/rtcore.h)
    set(PATINA_EMBREE_MAJOR 4)
else()
    set(PATINA_EMBREE_MAJOR 3)
endif()
find_library(Embree_LIBRARY NAMES embree${PATINA_EMBREE_MAJOR})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Embree REQUIRED_VARS Embree_LIBRARY Embree_INCLUDE_DIR)
if(Embree_FOUND AND NOT TARGET Embree::embree)
    add_library(Embree::embree UNKNOWN IMPORTED)
    set_target_properties(Embree::embree PROPERTIES
        IMPORTED_LOCATION ${Embree_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${Embree_INCLUDE_DIR}
        INTERFACE_COMPILE_DEFINITIONS PATINA_EMBREE_MAJOR=${PATINA_EMBREE_MAJOR})
endif()
