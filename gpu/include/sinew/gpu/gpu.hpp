// SPDX-License-Identifier: BSL-1.0
#pragma once

// Scenes on a device: with this header the DataTypes CudaVec3f, CudaVec3d, CudaRigid3f and CudaRigid3d are
// there, and a scene is simulated on the device by being written over them.

#include <sinew/gpu/conjugate_gradients.hpp>
#include <sinew/gpu/data_types.hpp>
#include <sinew/gpu/element_driver.hpp>
#include <sinew/gpu/grid_loops.hpp>
#include <sinew/gpu/multigrid_gradients.hpp>
#include <sinew/gpu/point_weights.hpp>
#include <sinew/gpu/rigid_loops.hpp>
#include <sinew/gpu/sph_driver.hpp>
#include <sinew/gpu/vector_operations.hpp>
