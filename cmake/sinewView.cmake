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

# A window onto scenes, where GLFW and Dear ImGui are installed, too: the target sinew::window, for sinew/view/window.hpp.
find_path(SINEW_GLFW_INCLUDE_DIR GLFW/glfw3.h DOC "Folder that holds GLFW/glfw3.h")
find_library(SINEW_GLFW_LIBRARY glfw DOC "Library of GLFW")
find_path(SINEW_IMGUI_INCLUDE_DIR backends/imgui_impl_glfw.h PATH_SUFFIXES imgui DOC "Folder that holds imgui.h and backends/")
find_library(SINEW_IMGUI_LIBRARY imgui DOC "Library of Dear ImGui")
find_library(SINEW_STB_LIBRARY stb DOC "Library of stb, for Dear ImGui")
mark_as_advanced(SINEW_GLFW_INCLUDE_DIR SINEW_GLFW_LIBRARY SINEW_IMGUI_INCLUDE_DIR SINEW_IMGUI_LIBRARY SINEW_STB_LIBRARY)
if(TARGET sinew::view AND SINEW_GLFW_INCLUDE_DIR AND SINEW_GLFW_LIBRARY AND SINEW_IMGUI_INCLUDE_DIR AND SINEW_IMGUI_LIBRARY AND SINEW_STB_LIBRARY
   AND NOT TARGET sinew::window)
  find_package(Threads REQUIRED)
  add_library(sinew::window INTERFACE IMPORTED GLOBAL)
  set(sinew_window_folders ${SINEW_IMGUI_INCLUDE_DIR} ${SINEW_GLFW_INCLUDE_DIR})
  list(REMOVE_DUPLICATES sinew_window_folders)
  set_target_properties(sinew::window PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${sinew_window_folders}")
  set_property(TARGET sinew::window PROPERTY INTERFACE_LINK_LIBRARIES sinew::view ${SINEW_IMGUI_LIBRARY} ${SINEW_STB_LIBRARY}
               ${SINEW_GLFW_LIBRARY} ${CMAKE_DL_LIBS} Threads::Threads)
endif()
