// SPDX-License-Identifier: BSL-1.0
#pragma once

// Runtime scenes of the standard registry, instantiated once in the library sinew::standard of the CMake
// project, so that a program which links it compiles in seconds. Without it, include
// sinew/runtime/runtime.hpp.
#include <sinew/runtime/bake.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>

namespace sinew {

using StandardSimulation = Simulation<RuntimeNode<Standard>>;

extern template void StandardSimulation::init();
extern template void StandardSimulation::initScene(RootScope const&, bool);
extern template void StandardSimulation::animate(double);
extern template void StandardSimulation::reset();
extern template void StandardSimulation::propagate();
extern template void StandardSimulation::updateVisual();
extern template double StandardSimulation::kineticEnergy();
extern template double StandardSimulation::potentialEnergy();

extern template std::vector<ClassInfo> make_class_table<Standard>();
extern template ReadScene<Standard> read_scene<Standard>(std::string const&, ReadSceneOptions const&);
extern template ReadScene<Standard> parse_scene<Standard>(std::string const&, std::string,
                                                          ReadSceneOptions const&);
extern template std::string bake_text<Standard>(ReadScene<Standard>, std::string const&, BakeOptions const&);

}  // namespace sinew
