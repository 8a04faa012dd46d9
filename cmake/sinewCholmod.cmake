# CHOLMOD, where it is installed: the target sinew::cholmod, which sinew/solver/cholmod_solver.hpp needs.
find_path(SINEW_CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse DOC "Folder that holds cholmod.h")
find_library(SINEW_CHOLMOD_LIBRARY cholmod DOC "Library of CHOLMOD")
mark_as_advanced(SINEW_CHOLMOD_INCLUDE_DIR SINEW_CHOLMOD_LIBRARY)
if(SINEW_CHOLMOD_INCLUDE_DIR AND SINEW_CHOLMOD_LIBRARY AND NOT TARGET sinew::cholmod)
  add_library(sinew::cholmod INTERFACE IMPORTED GLOBAL)
  set_target_properties(sinew::cholmod PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${SINEW_CHOLMOD_INCLUDE_DIR}"
                                                  INTERFACE_LINK_LIBRARIES "${SINEW_CHOLMOD_LIBRARY}")
endif()
