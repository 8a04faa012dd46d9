# libccd, where it is installed: the target sinew::ccd, which sinew/collision/convex.hpp needs.
find_path(SINEW_CCD_INCLUDE_DIR ccd/ccd.h DOC "Folder that holds ccd/ccd.h")
find_library(SINEW_CCD_LIBRARY ccd DOC "Library of libccd")
mark_as_advanced(SINEW_CCD_INCLUDE_DIR SINEW_CCD_LIBRARY)
if(SINEW_CCD_INCLUDE_DIR AND SINEW_CCD_LIBRARY AND NOT TARGET sinew::ccd)
  add_library(sinew::ccd INTERFACE IMPORTED GLOBAL)
  set_target_properties(sinew::ccd PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${SINEW_CCD_INCLUDE_DIR}"
                                              INTERFACE_LINK_LIBRARIES "${SINEW_CCD_LIBRARY}")
endif()
