# MPI, PETSc for real numbers and METIS, where all three are installed (Debian: petsc-dev libopenmpi-dev libmetis-dev): the target
# sinew::mpi, which the headers of sinew/mpi need. Of MPI only its C functions are used.
find_path(SINEW_MPI_INCLUDE_DIR mpi.h PATH_SUFFIXES openmpi/include ${CMAKE_LIBRARY_ARCHITECTURE}/openmpi/include
          PATHS /usr/lib /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE} NO_CMAKE_SYSTEM_PATH DOC "Folder that holds mpi.h")
find_library(SINEW_MPI_LIBRARY mpi DOC "Library of MPI")
find_path(SINEW_PETSC_INCLUDE_DIR petscksp.h PATHS /usr/lib/petsc/include DOC "Folder that holds petscksp.h")
find_library(SINEW_PETSC_LIBRARY petsc_real PATHS /usr/lib/petsc/lib DOC "Library of PETSc")
find_path(SINEW_METIS_INCLUDE_DIR metis.h DOC "Folder that holds metis.h")
find_library(SINEW_METIS_LIBRARY metis DOC "Library of METIS")
mark_as_advanced(SINEW_MPI_INCLUDE_DIR SINEW_MPI_LIBRARY SINEW_PETSC_INCLUDE_DIR SINEW_PETSC_LIBRARY SINEW_METIS_INCLUDE_DIR
                 SINEW_METIS_LIBRARY)
if(SINEW_MPI_INCLUDE_DIR AND SINEW_MPI_LIBRARY AND SINEW_PETSC_INCLUDE_DIR AND SINEW_PETSC_LIBRARY AND SINEW_METIS_INCLUDE_DIR
   AND SINEW_METIS_LIBRARY AND NOT TARGET sinew::mpi)
  add_library(sinew::mpi INTERFACE IMPORTED GLOBAL)
  set_target_properties(sinew::mpi PROPERTIES
                        INTERFACE_INCLUDE_DIRECTORIES "${SINEW_PETSC_INCLUDE_DIR};${SINEW_MPI_INCLUDE_DIR};${SINEW_METIS_INCLUDE_DIR}"
                        INTERFACE_COMPILE_DEFINITIONS OMPI_SKIP_MPICXX
                        INTERFACE_LINK_LIBRARIES "${SINEW_PETSC_LIBRARY};${SINEW_MPI_LIBRARY};${SINEW_METIS_LIBRARY}")
endif()
