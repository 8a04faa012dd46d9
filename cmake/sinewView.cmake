# Pictures of scenes, where OpenGL's functions and a writer of PNG files are installed: the target sinew::view, which the headers of
# sinew/view need.
find_path(SINEW_EPOXY_INCLUDE_DIR epoxy/egl.h DOC "Folder that holds epoxy/egl.h")
find_library(SINEW_EPOXY_LIBRARY epoxy DOC "Library of libepoxy")
find_path(SINEW_EGL_INCLUDE_DIR EGL/eglplatform.h DOC "Folder that holds EGL/eglplatform.h")
find_path(SINEW_STB_INCLUDE_DIR stb/stb_image_write.h DOC "Folder that holds stb/stb_image_write.h")
mark_as_advanced(SINEW_EPOXY_INCLUDE_DIR SINEW_EPOXY_LIBRARY SINEW_EGL_INCLUDE_DIR SINEW_STB_INCLUDE_DIR)
if(SINEW_EPOXY_INCLUDE_DIR AND SINEW_EPOXY_LIBRARY AND SINEW_EGL_INCLUDE_DIR AND SINEW_STB_INCLUDE_DIR AND NOT TARGET sinew::view)
  add_library(sinew::view INTERFACE IMPORTED GLOBAL)
  set(sinew_view_folders ${SINEW_EPOXY_INCLUDE_DIR} ${SINEW_EGL_INCLUDE_DIR} ${SINEW_STB_INCLUDE_DIR})
  list(REMOVE_DUPLICATES sinew_view_folders)
  set_target_properties(sinew::view PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${sinew_view_folders}"
                                               INTERFACE_LINK_LIBRARIES "${SINEW_EPOXY_LIBRARY}")
endif()
