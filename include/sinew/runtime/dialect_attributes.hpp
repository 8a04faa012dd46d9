// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

// What becomes of the attributes that components have in SOFA and none of ours is: they have no effect on what is
// simulated, or are not simulated, and then only their defaults are taken. tests/runtime/sofa_attributes.cpp holds these
// lists, and the fields of all classes, against those of SOFA.
namespace sinew::dialect {

/// Attributes of any component that concern pictures, messages, storage and threads, that are results, or that are left over
/// in well-known scenes.
inline constexpr std::array withoutEffect = std::to_array<std::string_view>({
    "alphaBlend", "applyRestPosition", "arrowSizeCoef", "assembling", "bbox", "beamsData", "bitangents", "blendEquation",
    "blendTransparency", "checkConnexity", "checkIndices", "checkJacobian", "checkTopology", "color",
    "componentState", "computeAllBuffers", "computeBoundingBox", "computeForceDerivStrategy",
    "computeForceStrategy", "computeGlobalMatrix", "computeHamiltonian",
    "computeGraphs", "computeMassOnRest", "computeMaterialFaces", "computeNormals", "computeQuads", "computeResidual",
    "computeTangents", "computeTextureCoordinates", "computeVonMisesStress", "constraint",
    "constraintIndex", "constraintSolver", "contacts", "context", "createQuadArray", "createSubelements", "createTexCoords",
    "createTriangleArray", "cullFace", "currentError", "currentIterations", "currentNumConstraintGroups", "currentNumConstraints", "debug", "debugGrid", "debugViewFrameScale", "defaultMaterial", "depth", "depthTest", "derivX",
    "destFactor", "displayDebug", "displayFreePosition", "doUpdate", "edgeInfo", "edgeOutIndices", "edgePressureMap",
    "edgesGroups", "edgesOutROI", "elementSpace", "enable", "enableAssembly", "faceList", "factorizationInvalidation",
    "fixMergedUVSeams", "forceBinary", "free_position", "free_velocity", "gatherBsize", "gatherPt", "graph",
    "graphConstraints", "graphErrors", "graphForces", "graphViolations", "group", "groups", "hamiltonianEnergy", "handleDynamicTopology", "handleSeams", "handleTopologyChange",
    "headerSize", "hexahedraGroups", "hexahedronInfo", "highOrderEdgePositions",
    "highOrderHexahedronPositions", "highOrderQuadPositions", "highOrderTetrahedronPositions",
    "highOrderTrianglePositions", "initialTransformation", "initRestPositions", "input_nodes",
    "isMechanical", "isToPrint", "keepLines", "L_nnz", "linearSolver", "linearSystem", "lineSmooth",
    "lineWidth", "listActiveTriangles", "listening", "loadMaterial", "mapMatrices", "mappingJacobian",
    "mappingType", "material", "materials", "mechanicalObject", "mstate", "multithreading",
    "nbMaxIterations", "nbPoints", "nbThreads", "noNewTriangles", "normal", "normals", "normalsDefinition",
    "normalsIndex", "numberOfContacts", "ordering", "orderingMethod", "parallelCollisionDetectionAndFreeMotion", "parallelDetection",
    "parallelInverseProduct", "parallelODESolving", "ParameterFile", "planeColor",
    "pointSize", "pointSmooth", "pointsOutROI", "polygonsGroups",
    "positionsDefinition", "precomputeSymbolicDecomposition", "preconditioner", "preconditioners",
    "preserveOrder", "primitiveType", "printLog", "printMass", "prismsGroups", "profiling",
    "putOnlyTexCoords", "pyramidsGroups", "quadInfo", "quadPressureMap", "quadsGroups", "reserve", "residual",
    "residualGraph", "restPosition", "rotatedInitialElements", "rotationTex", "saveEnergyInFile",
    "shadows", "showCellWidth", "showTranslation", "sourceFactor", "springColor", "srgbTexturing", "static", "stiffnessMatrices",
    "stressMaxValue", "tags", "tangents", "taskSchedulerType", "tetrahedraGroups", "tetrahedraOutROI",
    "tetrahedronInfo", "tetrahedronOutIndices", "texcoords", "texcoordsDefinition", "texcoordsIndex",
    "texturename", "threading", "threadSafeVisitor", "tolerance_show", "topology",
    "triangleInfo", "triangleOutIndices", "trianglePressureMap", "trianglesGroups", "trianglesOutROI",
    "triangleState", "updateNormals", "updateStiffness",  "updateTangents",
    "useCurvature", "useIncrementalPotentialEnergy", "useNormals", "useVBO", "useX0", "uv", "verbose",
    "vertexInfo", "vertices", "vertNormIdx", "vertPosIdx", "visible", "vonMisesPerElement", "wire_optimization",
    "vonMisesPerNode", "vonMisesStressColors", "warnWhenDiverge", "warnWhenLineSearchFails",
    "writeZTransparent"});

/// The same of one class, by its own name.
struct AttributeOf {
  std::string_view className, attribute;
};
inline constexpr std::array withoutEffectOf = std::to_array<AttributeOf>({
    {"AffineMovementConstraint", "meshIndices"}, {"AngularSpringForceField", "limit"},
    {"AdaptiveBeamMapping", "nameOfInputMap"}, {"AdaptiveBeamMapping", "parallelMapping"},
    {"AdaptiveBeamMapping", "segmentsCurvAbs"}, {"InterventionalRadiologyController", "fixedConstraint"},
    {"InterventionalRadiologyController", "threshold"}, {"RodSpireSection", "nbEdgesVisu"},
    {"RodStraightSection", "nbEdgesVisu"}, {"AngularSpringForceField", "recompute_indices"}, {"BeamFEMForceField", "useSymmetricAssembly"},
    {"BilateralLagrangianConstraint", "topology1"}, {"BilateralLagrangianConstraint", "topology2"},
    {"BoxROI", "box_roi"}, {"BoxROI", "indices"}, {"CarvingManager", "key"}, {"CarvingManager", "keySwitch"},
    {"CarvingManager", "mouseEvent"}, {"CarvingManager", "narrowPhaseDetection"},
    {"CarvingManager", "omniEvent"}, {"CubeTopology", "hexahedra"}, {"CubeTopology", "tetrahedra"},
    {"CubeTopology", "triangles"}, {"CylinderGridTopology", "tetrahedra"},
    {"DeformableOnRigidFrameMapping", "globalToLocalCoords"}, {"PrecomputedLinearSolver", "jmjt_twostep"},
    {"PrecomputedLinearSolver", "use_file"},
    {"EdgePressureForceField", "arrowSizeCoef"}, {"GenerateRigidMass", "polygons"},
    {"GridMeshCreator", "filename"}, {"GridMeshCreator", "hexahedra"}, {"GridMeshCreator", "polygons"},
    {"GridMeshCreator", "polylines"}, {"GridMeshCreator", "prisms"}, {"GridMeshCreator", "pyramids"},
    {"GridMeshCreator", "tetrahedra"}, {"ImprovedJacobiConstraintSolver", "sor"}, {"MechanicalObject", "force"}, {"MeshGmshLoader", "polygons"},
    {"MeshGmshLoader", "polylines"}, {"MeshOBJLoader", "polygons"}, {"MeshOBJLoader", "polylines"}, {"MeshSTLLoader", "polygons"},
    {"MeshSTLLoader", "polylines"},
    {"MeshVTKLoader", "polygons"},
    {"MeshVTKLoader", "polylines"}, {"ContinuousIntersection", "maxIterations"},
    {"ContinuousIntersection", "tolerance"}, {"VisualModel", "dfactor"}, {"VisualModel", "sfactor"},
    {"NNCGConstraintSolver", "sor"}, {"PreconditionedConjugateResidual", "sor"}, {"ParticleSink", "fixed"}, {"PositionBasedDynamicsProjectiveConstraint", "old_position"},
    {"PositionBasedDynamicsProjectiveConstraint", "velocity"}, {"PointCollisionModel", "leafScale"}, {"ParticleSource", "lastparticles"}, {"RegularGridTopology", "position"}, {"RegularGridTopology", "tetrahedra"},
    {"RestShapeSpringsForceField", "recompute_indices"}, {"PolynomialRestShapeSpringsForceField", "recompute_indices"}, {"SparseGridTopology", "tetrahedra"},
    {"SubsetTopology", "indices"}, {"TetrahedronDiffusionFEMForceField", "scalarDiffusion"}, {"SphereROI", "isVisible"}, {"ExtrudeSurface", "isVisible"},
    {"ExtrudeQuadsAndGenerateHexas", "isVisible"}, {"RandomPointDistributionInSurface", "isVisible"},
    {"MeshROI", "ROIedges"},
    {"ValuesFromIndices", "outStr"}, {"MergeMeshes", "polygons"}, {"MergePoints", "noUpdate"},
    {"GenerateCylinder", "BezierTetrahedronWeights"}, {"GenerateCylinder", "BezierTriangleWeights"},
    {"GenerateCylinder", "isBezierTetrahedronRational"}, {"GenerateCylinder", "isBezierTriangleRational"},
    {"GenerateSphere", "BezierTetrahedronWeights"}, {"GenerateSphere", "BezierTriangleWeights"},
    {"GenerateSphere", "isBezierTetrahedronRational"}, {"GenerateSphere", "isBezierTriangleRational"},
    {"VolumeFromTriangles", "update"}, {"VolumeFromVolumetricElements", "update"}, {"HausdorffDistance", "update"},
    {"Vertex2Frame", "texCoords"}, {"VoxelGridLoader", "segmentationHeader"}, {"MeshOffLoader", "polygons"},
    {"MeshOffLoader", "polylines"}, {"MeshPLYLoader", "polygons"}, {"MeshPLYLoader", "polylines"}, {"GIDMeshLoader", "polygons"}, {"GIDMeshLoader", "polylines"}, {"MeshTrianLoader", "polygons"},
    {"MeshTrianLoader", "polylines"},
    {"MeshTrianLoader", "edgesOnBorder"},
    {"MeshTrianLoader", "neighborTable"}, {"MeshTrianLoader", "trianglesOnBorderList"},
    {"StringMeshCreator", "filename"}, {"StringMeshCreator", "hexahedra"}, {"StringMeshCreator", "polygons"},
    {"SparseGridRamificationTopology", "tetrahedra"},
    {"SparseGridMultipleTopology", "tetrahedra"},
    {"GearSpringForceField", "filename"},
    {"GearSpringForceField", "period"},
    {"GearSpringForceField", "reinit"},
    {"JointSpringForceField", "outfile"},
    {"JointSpringForceField", "period"},
    {"JointSpringForceField", "reinit"},
    {"PatchTestMovementProjectiveConstraint", "meshIndices"},
    {"TriangularBiquadraticSpringsForceField", "matrixRegularization"},  // SOFA does not read it either
    {"StringMeshCreator", "polylines"}, {"StringMeshCreator", "prisms"}, {"StringMeshCreator", "pyramids"},
    {"StringMeshCreator", "quads"}, {"StringMeshCreator", "tetrahedra"}, {"StringMeshCreator", "triangles"},
    {"SlidingLagrangianConstraint", "force"}, {"SparseLDLSolver", "bandWidth"}, {"SparseLDLSolver", "conditionNumber"}, {"SparseLDLSolver", "minSingularValue"}, {"SparseLDLSolver", "showProblem"},
    {"SparseLDLSolver", "subpartSolve"}, {"SparseLDLSolver", "verification"}, {"SparseLDLSolver", "iterations"}, {"SparseLDLSolver", "threshold"}, {"SparseLDLSolver", "tolerance"},
    {"SphereGridTopology", "tetrahedra"}, {"TetrahedronFEMForceField", "indices"},
    {"TaitSurfacePressureForceField", "currentPressure"}, {"TaitSurfacePressureForceField", "currentStiffness"},
    {"TaitSurfacePressureForceField", "currentSurfaceArea"}, {"TaitSurfacePressureForceField", "currentVolume"},
    {"TaitSurfacePressureForceField", "initialSurfaceArea"}, {"TaitSurfacePressureForceField", "initialVolume"},
    {"TaitSurfacePressureForceField", "pressureTriangles"}, {"TaitSurfacePressureForceField", "surfaceAreaAfterTC"},
    {"TaitSurfacePressureForceField", "v0"}, {"TaitSurfacePressureForceField", "volumeAfterTC"},
    {"TopologicalChangeProcessor", "epsilonSnapBorder"}, {"TopologicalChangeProcessor", "listChanges"},
    {"TopologyBoundingTrasher", "position"}, {"TearingEngine", "input_position"}, {"TearingEngine", "maxStress"},
    {"TearingEngine", "triangleIdsOverThreshold"},
    {"TriangleFEMForceField", "computePrincipalStress"}, {"TriangleFEMForceField", "criteriaValue"},
    {"TriangleFEMForceField", "hosfordExponant"}, {"TrianglePressureForceField", "useConstantForce"},
    {"TriangularShellForceField", "arrow_radius"}, {"TriangularShellForceField", "measure"},
    {"VariationalSymplecticSolver", "file"}, {"WriteState", "DOFsV"}, {"WriteState", "DOFsX"}});

/// Attributes that change what is computed in SOFA and cannot here: with another value than their default a scene is another
/// one. `className`: of one class; empty: of any. `standard`: the values that mean nothing, apart by '|'.
struct NotSimulated {
  std::string_view className, attribute, standard;
};
inline constexpr std::array notSimulated = std::to_array<NotSimulated>({
    {"RigidDistanceGridCollisionModel", "sampling", "0"}, {"RigidDistanceGridCollisionModel", "dumpfilename", ""},
    {"AdaptiveBeamMapping", "contactDuplicate", "0"}, {"AdaptiveBeamMapping", "proximity", "0"},
    {"BeamInterpolation", "dofsAndBeamsAligned", "1"},
    {"InterventionalRadiologyController", "controlledInstrument", "0"},
    {"InterventionalRadiologyController", "rigidCurvAbs", ""}, {"AverageCoord", "vecId", "1"}, {"ClusteringEngine", "outFile", ""}, {"GenerateCylinder", "BezierTetrahedronDegree", ""},
    {"GenerateCylinder", "BezierTriangleDegree", ""}, {"GenerateSphere", "BezierTetrahedronDegree", ""},
    {"GenerateSphere", "BezierTriangleDegree", ""}, {"MeshTrianLoader", "trian2", "0"},
    {"", "box", ""},
    {"", "cauchyStress", "[ 0 0 0 , 0 0 0 , 0 0 0]"}, {"", "clamp", "0"},
    {"", "compute_mapping_inertia", "0"}, {"", "computePointList", "1"},
    {"", "computeWeightsFromPosition", "0"}, {"", "contactRestitution", "0"},
    {"", "convolutionSize", "0"}, {"", "damping", "0"}, {"", "dataResolution", "0 0 0"},
    {"", "defaultVolume", "-1"}, {"", "direction", ""}, {"", "edgeAngle", "0"}, {"", "edgeMass", ""},
    {"", "elongationOnly", "0"}, {"", "enabled", "1"}, {"", "endTime", "-1"},
    {"", "facets", ""},
    {"", "first", "4294967295"}, {"", "flipNormals", "0"},
    {"", "geometricStiffness", "Exact|1"}, {"", "ignoreNotFound", "0"}, {"", "indexFromEnd", "0"},
    {"", "indices", ""}, {"", "initialPoints", ""}, {"", "isCompliance", "0"}, {"", "last", "4294967295"},
    {"", "lastDir", ""}, {"", "lastFreeRotation", "0"}, {"", "lastPos", ""}, {"", "lengths", ""},
    {"MeshSpringForceField", "localRange", "4294967295 4294967295"},
    {"PlaneForceField", "localRange", "-1 -1"}, {"QuadBendingSprings", "localRange", "-1 -1"},
    {"SphereForceField", "localRange", "-1 -1"}, {"UniformMass", "localRange", "-1 -1"},
    {"", "localStiffnessFactor", ""}, {"", "mainDirection", "0 0 0 0 0 0"}, {"", "mapConstraints", "1"},
    {"", "mapForces", "1"}, {"", "mapMasses", "1"}, {"", "marchingCubeStep", "1"},
    {"DeformableOnRigidFrameMapping", "rootAngularForceScaleFactor", "1"},
    {"DeformableOnRigidFrameMapping", "rootLinearForceScaleFactor", "1"},
    {"", "mergePositionUsingMap", "1"}, {"", "minDistance", "-1"},
    {"", "onlyAttachedPoints", "0"}, {"", "pivot_points", ""}, {"", "positionFactor", "1"},
    {"", "preserveTotalMass", "0"}, {"CubeTopology", "prisms", ""}, {"CylinderGridTopology", "prisms", ""},
    {"RegularGridTopology", "prisms", ""}, {"SparseGridTopology", "prisms", ""},
    {"SparseGridRamificationTopology", "prisms", ""}, {"SparseGridRamificationTopology", "pyramids", ""},
    {"SparseGridMultipleTopology", "prisms", ""}, {"SparseGridMultipleTopology", "pyramids", ""},
    {"JointSpringForceField", "infile", ""},
    {"SphereGridTopology", "prisms", ""}, {"CubeTopology", "pyramids", ""},
    {"CylinderGridTopology", "pyramids", ""},
    {"RegularGridTopology", "pyramids", ""}, {"SparseGridTopology", "pyramids", ""},
    {"SphereGridTopology", "pyramids", ""}, {"", "rayleighMass", "0"},
    {"", "rayleighStiffness", "0"}, {"PolynomialSpringsForceField", "recompute_indices", "0"},
    {"", "resizeToModel", "0"}, {"", "responseFactor", "1"},
    {"", "restRotations", "0"}, {"MechanicalObject", "restScale", "1"}, {"", "rotation2", "0 0 0"},
    {"", "separateGravity", "0"}, {"", "size", "0|1"}, {"", "solveConstraint", "0"},
    {"", "spring", ""}, {"", "springsIndices1", ""},
    {"", "springsIndices2", ""},     {"", "transformation", "[1 0 0 0,0 1 0 0,0 0 1 0,0 0 0 1]"}, {"", "translation2", "0 0 0"},
    {"", "triAngle", "0"}, {"", "triangulate", "0"}, {"", "updateStateWhenDiverged", "1"}, {"", "updateStiffnessMatrix", "0"},
    {"", "useLineLine", "1"}, {"LCPConstraintSolver", "multi_grid", "0|false"}, {"", "useLinePoint", "1"},
    {"", "usePointPoint", "1"},
    {"", "useSphereTriangle", "1"},
    {"", "useSurfaceNormals", "0"}, {"", "useTangentStiffness", "1"}, {"", "useTopology", "1"},
    {"", "velocityFactor", "1"}, {"", "vertexMass", ""}, {"", "volumeConservationMode", "0"},
    {"", "voxelSize", "1 1 1"}});

/// Of these, what SOFA does by an approximation of which forces have no energy, and is done in another way here.
struct AnotherLaw {
  std::string_view className, attribute, difference;
};
inline constexpr std::array anotherLaw = std::to_array<AnotherLaw>(
    {{"TetrahedronFEMForceField",
      "updateStiffnessMatrix",
      "SOFA takes the gradients of the deformed element; here they are those at rest, with which forces have an energy"}});

inline bool without_effect(std::string_view name) {
  return name.starts_with("show") || name.starts_with("draw") ||
         std::find(withoutEffect.begin(), withoutEffect.end(), name) != withoutEffect.end();
}
/// `className`: the component's own name, not an alias.
inline bool without_effect(std::string_view className, std::string_view name) {
  return without_effect(name) ||
         std::any_of(withoutEffectOf.begin(), withoutEffectOf.end(), [&](AttributeOf const& of) {
           return of.className == className && of.attribute == name;
         });
}
inline NotSimulated const* not_simulated(std::string_view className, std::string_view name) {
  for (auto const& n : notSimulated)
    if (n.attribute == name && (n.className.empty() || n.className == className)) return &n;
  return nullptr;
}

namespace detail {
// words without brackets and commas, numbers as such: "[1 0,0 1]" and "1 0 0 1.0" are the same
inline std::vector<std::string> plain_words(std::string_view value) {
  std::vector<std::string> words;
  std::string word;
  auto end = [&] {
    if (word.empty()) return;
    double number = 0;
    auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (word == "true") word = "1";
    if (word == "false") word = "0";
    if (error == std::errc() && rest == word.data() + word.size()) {
      char shortest[40];
      word.assign(shortest, std::to_chars(shortest, shortest + sizeof shortest, number + 0.0).ptr);
    }
    words.push_back(std::move(word));
    word.clear();
  };
  for (const char c : value)
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == '[' || c == ']')
      end();
    else
      word += c;
  end();
  return words;
}
}  // namespace detail

/// Whether a value is one of those that mean nothing.
inline bool is_standard(NotSimulated const& attribute, std::string_view value) {
  const auto words = detail::plain_words(value);
  for (std::string_view rest = attribute.standard;;) {
    const std::size_t bar = std::min(rest.find('|'), rest.size());
    if (detail::plain_words(rest.substr(0, bar)) == words) return true;
    if (bar == rest.size()) return false;
    rest.remove_prefix(bar + 1);
  }
}

}  // namespace sinew::dialect
