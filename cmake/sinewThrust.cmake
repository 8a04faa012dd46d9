# Thrust for compilers of the processor, where it is installed: sinew::gpu needs it. nvcc has its own.
find_path(SINEW_THRUST_INCLUDE_DIR thrust/version.h PATHS /usr/local/cuda/include/cccl /usr/local/cuda/include
          DOC "Folder that holds thrust/version.h (Debian: libthrust-dev)")
mark_as_advanced(SINEW_THRUST_INCLUDE_DIR)
get_property(sinew_languages GLOBAL PROPERTY ENABLED_LANGUAGES)
set(sinew_gpu_can_be_had FALSE)
if(SINEW_THRUST_INCLUDE_DIR OR CUDA IN_LIST sinew_languages)
  set(sinew_gpu_can_be_had TRUE)
endif()
