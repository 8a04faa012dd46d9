# What `./dev test` compiles and runs; all other files of tests belong to `./dev test all`, where they carry the label "more".
# Each list is that of a program, with the folder of a file where the program has files of several folders. A program without a list
# is in both as a whole.
set(SINEW_TEST_SUITE quick CACHE STRING "quick: each kind of thing once, in minutes; all: everything")
set_property(CACHE SINEW_TEST_SUITE PROPERTY STRINGS quick all)
set(more OFF)
if(SINEW_TEST_SUITE STREQUAL "all")
  set(more ON)
elseif(NOT SINEW_TEST_SUITE STREQUAL "quick")
  message(FATAL_ERROR "SINEW_TEST_SUITE is '${SINEW_TEST_SUITE}'; it is quick or all")
endif()
# clang makes all files, in less than half of the time of g++; g++ makes what is quick, for its warnings, and what only it can. The
# standard registry of scene files is a third of an hour of g++, so that g++ checks it without code, and reads files by a small one
set(gcc OFF)
set(rest ${more})
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(gcc ON)
  set(rest OFF)
endif()

set(quick_topology adjacency cut_plan hexahedra mesh_topology refinement regular_grid regular_grid_topology removal_plan round_grids surface_mesh)
set(quick_collision axis_box bounding_tree broad_phase closest_points contact_laws contact_scenes friction overlap ray_hits surface_elements
    time_of_impact)
set(quick_scene bad_input element_removal live_engines picking place reset simulation)
set(quick_components constraint/constraints control/trajectory fluid/fluid_components fluid/poisson_multigrid mapping/measuring_mappings solver/direct_solvers solver/solver_fields)
set(quick_core data_types dual element_driver element_force error lanes block_ldl block_matrix factored_rows preconditioner convex_step)
set(quick_lagrangian constrained_step contact_friction)
# each component over the DataTypes that most scenes have
set(quick_laws constraints_vec3 elements_vec3d force_rigid3d force_vec3d hyperelastic_vec3d loads_vec3d mappings_points
    mappings_rigid masses spatial_springs_vec3d)
set(quick_validation cantilever kepler settled statics vibration)
set(quick_runtime bad_places bake_text change contact dialect dialect_run every_class live_engines read_scene same_bits_string sofa_attributes
    step_forces)
set(gcc_runtime tearing)  # all that g++ makes of runtime: a scene file with a registry of its own
set(quick_baked tetrahedra)
set(quick_ccd collision/hull_pairs)
set(quick_view picture)
# pages of components, one of each role, whose C++ is compiled
set(quick_component_examples BarycentricMapping BilateralLagrangianConstraint BoxROI CGLinearSolver ContinuousIntersection
    ConvexConstraintSolver DiagonalMass FixedConstraint FreeMotionAnimationLoop Gravity MechanicalObject MeshGmshLoader MeshTopology
    NewmarkImplicitSolver StiffSpringForceField TetrahedronFEMForceField Threads TreeBroadPhase TriangleCollisionModel
    UncoupledConstraintCorrection VisualModel WriteState)
set(quick_examples liver one_tetrahedron string_on_rigid)
# the mistakes that beginners make
set(quick_mistakes collision_without_pipeline force_misspelt force_no_add_force force_not_assembled force_of_other_types
    force_without_state implicit_without_linear mapping_without_parent mass_without_state no_class_name node_by_string not_a_component tetrahedra_without_topology two_states unknown_path)

# the files of a program that are in quick, and the others; without those, where they are not made
function(sinew_suite name)
  set(of_quick ${ARGN})
  set(of_more)
  if(DEFINED quick_${name})
    set(missing ${quick_${name}})
    foreach(file ${ARGN})
      get_filename_component(stem ${file} NAME_WE)
      get_filename_component(folder ${file} DIRECTORY)
      get_filename_component(folder ${folder} NAME)
      if(NOT stem IN_LIST quick_${name} AND NOT ${folder}/${stem} IN_LIST quick_${name})
        list(REMOVE_ITEM of_quick ${file})
        list(APPEND of_more ${file})
      endif()
      list(REMOVE_ITEM missing ${stem} ${folder}/${stem})
    endforeach()
    if(missing)
      message(FATAL_ERROR "tests/suites.cmake names files that the suite ${name} does not have: ${missing}")
    endif()
  endif()
  if(NOT rest)
    set(of_more)
  endif()
  set(quick ${of_quick} PARENT_SCOPE)
  set(others ${of_more} PARENT_SCOPE)
endfunction()
