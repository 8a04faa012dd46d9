// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>

#include <algorithm>
#include <array>
#include <string_view>

// What SOFA's scenes say that has no meaning here, or none yet: classes, and attributes of nodes, that a
// scene may have without an error. Classes that do have a meaning are in the registry, with their aliases;
// dialect_attributes.hpp has the attributes of components.
namespace sinew::dialect {

/// Programs, pictures, windows, and helpers of data structures that Sinew does not need.
inline constexpr std::array withoutMeaning =
    std::to_array<std::string_view>({"RequiredPlugin",
                                     "VisualStyle",
                                     "DefaultAnimationLoop",
                                     "DefaultVisualManagerLoop",
                                     "BackgroundSetting",
                                     "ViewerSetting",
                                     "InteractiveCamera",
                                     "OrthographicCamera",
                                     "Camera",
                                     "LightManager",
                                     "SpotLight",
                                     "PositionalLight",
                                     "DirectionalLight",
                                     "OglSceneFrame",
                                     "OglLabel",
                                     "OglGrid",
                                     "OglColorMap",
                                     "OglShadowShader",
                                     "VisualGrid",
                                     "InfoComponent",
                                     "MessageHandlerComponent",
                                     "StatsSetting",
                                     "MouseButtonSetting",
                                     "AttachBodyButtonSetting",
                                     "SofaDefaultPathSetting",
                                     "DefaultPathSetting",
                                     "AddResourceRepository",
                                     "AddDataRepository",
                                     "APIVersion",
                                     "PauseAnimation",
                                     "PauseAnimationOnEvent",
                                     "Visual3DText",
                                     "Text",
                                     "MeshTopologicalMapping",
                                     "RenderingOrder",
                                     "DataDisplay",
                                     "Monitor",
                                     "TrailRenderer",
                                     "LineAxis",
                                     "RecordedCamera",
                                     "GraphScatteredMatrix",
                                     "TreeTopology",
                                     "CompareState",
                                     "CompareTopology",
                                     "ExtraMonitor",
                                     "EvalPointsDistance",
                                     "EvalSurfaceDistance",
                                     "TopologyChecker",
                                     "VTKExporter",
                                     "MeshExporter",
                                     "OBJExporter",
                                     "STLExporter",
                                     "BlenderExporter",
                                     "WriteTopology",
                                     "OglCylinderModel",
                                     "OglTexture2D",
                                     "OglShader",
                                     "OglShaderDefineMacro",
                                     "OglViewport",
                                     "ClipPlane",
                                     "VisualVectorField",
                                     "VisualMesh",
                                     "VisualPointCloud",
                                     "VisualBoundingBox",
                                     "CylinderVisualModel",
                                     "PointSplatModel",
                                     "MergeVisualModels",
                                     "OglTexture",
                                     "OrderIndependentTransparencyManager",
                                     "PostProcessManager",
                                     "TextureInterpolation",
                                     "VisualModelOBJExporter",
                                     "GlobalSystemMatrixImage",
                                     "MatrixLinearSystem",
                                     "MatrixFreeSystem",
                                     "PreconditionedMatrixFreeSystem",
                                     "RotationMatrixSystem",
                                     "PrecomputedMatrixSystem",
                                     "ConstantSparsityProjectionMethod",
                                     "MatrixProjectionMethod",
                                     "NaturalOrderingMethod",
                                     "AMDOrderingMethod",
                                     "COLAMDOrderingMethod",
                                     "ConstantSparsityPatternSystem",
                                     "CompositeLinearSystem",
                                     "BaseCamera",
                                     "CubeModel",
                                     "CubeCollisionModel",
                                     "CollisionLoop",
                                     "ContactListener",
                                     "ConstraintAttachButtonSetting",
                                     "FixPickedParticleButtonSetting",
                                     "AddFrameButtonSetting",
                                     "AddRecordedCameraButtonSetting",
                                     "StartNavigationButtonSetting",
                                     "TaskSchedulerSettings",  // Threads says how many there are
                                     "SpatialGridContainer",   // neighbours are found by cells anyway

                                     "DisplayFlagsSetting"});

/// Those of them that name a folder of data.
inline constexpr std::array dataRepositories =
    std::to_array<std::string_view>({"AddDataRepository", "AddResourceRepository"});

/// Those of them that say how a scene is looked at: pictures and windows have them.
inline constexpr std::array ofViews = std::to_array<std::string_view>({"VisualStyle",
                                                                       "DisplayFlagsSetting",
                                                                       "BackgroundSetting",
                                                                       "InteractiveCamera",
                                                                       "OrthographicCamera",
                                                                       "Camera",
                                                                       "BaseCamera",
                                                                       "OglSceneFrame",
                                                                       "OglGrid",
                                                                       "VisualGrid",
                                                                       "LineAxis",
                                                                       "ClipPlane",
                                                                       "LightManager",
                                                                       "SpotLight",
                                                                       "PositionalLight",
                                                                       "DirectionalLight"});

/// Shows values of a state by colours of its own: what is mapped onto it is a picture, too.
inline constexpr std::string_view shownByColours = "DataDisplay";

/// Forces that have the mass of their elements with them: a force and a mass.
struct ForceAndMass {
  std::string_view name, force, mass;
  bool fillWeighted;               // cells of a grid over a surface weigh by how filled they are
  std::string_view interpolation;  // of hexahedra that are made of finer cells; empty for others
};
inline constexpr std::string_view compositeForce = "HexahedronCompositeFEMForceField",
                                  compositeMass = "HexahedronCompositeFEMMass",
                                  compositeMapping = "HexahedronCompositeFEMMapping",
                                  rodForce = "AdaptiveBeamForceField", rodMass = "AdaptiveBeamMass";
inline constexpr std::array forcesAndMasses = std::to_array<ForceAndMass>(
    {{"HexahedronFEMForceFieldAndMass", "HexahedronFEMForceField", "MeshMatrixMass", true, ""},
     {"HexahedralFEMForceFieldAndMass", "HexahedronFEMForceField", "MeshMatrixMass", false, ""},
     {"HexahedronCompositeFEMForceFieldAndMass", compositeForce, compositeMass, false, "condensed"},
     {"NonUniformHexahedronFEMForceFieldAndMass", compositeForce, compositeMass, false, "trilinear"},
     {"AdaptiveBeamForceFieldAndMass", rodForce, rodMass, false, ""}});
/// Fields that in SOFA are links to the whole of a component, and what of it they are here.
struct WholeLink {
  std::string_view field, data;
};
inline constexpr std::array wholeLinks = std::to_array<WholeLink>({{"interpolation", "beams"},
                                                                   {"wireRestShape", "beams"},
                                                                   {"instruments", "beams"},
                                                                   {"wireMaterials", "section"}});
constexpr ForceAndMass const* force_and_mass(std::string_view tag) {
  for (auto const& both : forcesAndMasses)
    if (both.name == tag) return &both;
  return nullptr;
}

/// Classes that are not there, by names with blanks between, and what follows from it for a scene.
struct ClassesLeftOut {
  std::string_view names, why;
};
constexpr ClassesLeftOut const* left_out(auto const& list, std::string_view tag) {
  for (ClassesLeftOut const& classes : list)
    if (has_name(classes.names, tag)) return &classes;
  return nullptr;
}

/// What changes the motion in SOFA, and would be missed.
inline constexpr std::array notYet = std::to_array<ClassesLeftOut>(
    {{"CylinderModel RayModel RayCollisionModel",
      "collides with nothing here; take triangles, lines, points, spheres, capsules, boxes or convex hulls"},
     {"ArticulatedHierarchyBVHController ArticulatedHierarchyController",
      "is not there; move the angles of articulated bodies by a LinearMovementProjectiveConstraint"},
     {"DirectSAPNarrowPhase", "is no stage here; take BVHNarrowPhase, which finds the same pairs"},
     {"RayTraceDetection",
      "is two stages here, as it is in SOFA by now; take BruteForceBroadPhase and RayTraceNarrowPhase"}});

/// What prepares or solves something that the scene may not have at all.
inline constexpr std::array inert = std::to_array<ClassesLeftOut>(
    {{"LMConstraintSolver LMConstraintDirectSolver",
      "does nothing: constraints by multipliers are solved where the root has a FreeMotionAnimationLoop"},
     {"CollisionGroupManager DefaultCollisionGroupManager TreeCollisionGroupManager CollisionGroup",
      "does nothing: bodies that touch stay under their own solvers; put them below one, so that their "
      "contact is part of its system"},
     {"MechanicalStateController",
      "does nothing: it moves a body by events of a mouse or a device; take a HapticController, a "
      "TrajectoryController, or the mouse of sinew view"},
     {"SubsetTopologicalMapping",
      "does nothing: a part of a mesh is what its own topology says; elements that are removed from the "
      "whole go "
      "from the part where that is below an IdentityMapping, and by their points"}});

/// Classes that need a package, and are in programs that were built where it was installed.
struct ClassOfPackage {
  std::string_view names, package, debian;
};
inline constexpr std::array classesOfPackages = std::to_array<ClassOfPackage>(
    {{"ConvexCollisionModel TBulletConvexHullModel BulletConvexHullModel BtConvexHullModel BulletConvexHull "
      "BtConvexHull OBBCollisionModel OBBModel TOBBModel OBB RigidCapsuleCollisionModel RigidCapsuleModel "
      "RigidCapsule",
      "libccd",
      "libccd-dev"}});

inline constexpr std::array suffixesWithoutMeaning =
    std::to_array<std::string_view>({"GeometryAlgorithms", "TopologyModifier", "TopologyAlgorithms"});
/// Of what a shader reads: OglFloatVariable, OglInt4Attribute, ...
constexpr bool is_of_shader(std::string_view tag) {
  return tag.starts_with("Ogl") && (tag.ends_with("Variable") || tag.ends_with("Attribute"));
}

/// Attributes of nodes that concern pictures or bookkeeping.
inline constexpr std::array nodeAttributesWithoutMeaning =
    std::to_array<std::string_view>({"printLog",
                                     "tags",
                                     "id",  // nothing refers to it
                                     "bbox",
                                     "componentState",
                                     "listening",
                                     "animate",
                                     "time",
                                     "depend",
                                     "sleeping",
                                     "canChangeSleepingState",
                                     "multithreadSimulation",
                                     "multiThreadSimulation",
                                     "currentLevel",  // of resolutions, which SOFA has no longer
                                     "coarsestLevel",
                                     "finestLevel",
                                     "visual",
                                     "color",
                                     "defaultContactDistance",
                                     "defaultAlarmDistance"});

/// Classes that are another one with an attribute of its own, where that is not given.
struct StandsFor {
  std::string_view name, className, attribute, value;
};
inline constexpr std::array standsFor = std::to_array<StandsFor>(
    {{"BDF1OdeSolver", "BDFOdeSolver", "order", "1"},
     {"BDF1", "BDFOdeSolver", "order", "1"},
     {"TriangularBendingFEMForceField", "TriangularShellForceField", "bending", "0"},
     {"FastTetrahedralCorotationalForceField", "TetrahedronFEMForceField", "method", "large"},
     {"TetrahedralTensorMassForceField", "TetrahedronFEMForceField", "method", "small"},
     {"TetrahedralTensorMassForceField", "TetrahedronFEMForceField", "youngModulus", "1000"},
     {"TetrahedralTensorMassForceField", "TetrahedronFEMForceField", "poissonRatio", "0.3"},
     {"NodalLinearDampingForceField", "UniformVelocityDampingForceField", "implicit", "1"},
     {"InteractionEllipsoidForceField", "InteractionEllipsoidForceField", "object2_forces", "1"}});

/// Words that such a class has for values of an attribute of the other one.
struct OtherWord {
  std::string_view name, attribute, word, value;
};
inline constexpr std::array otherWords =
    std::to_array<OtherWord>({{"FastTetrahedralCorotationalForceField", "method", "qr", "large"},
                              {"FastTetrahedralCorotationalForceField", "method", "polar", "nearest"},
                              {"FastTetrahedralCorotationalForceField", "method", "polar2", "polar"},
                              {"FastTetrahedralCorotationalForceField", "method", "none", "small"},
                              {"FastTetrahedralCorotationalForceField", "method", "linear", "small"}});

/// Classes over a kind of elements, which their template names behind the DataTypes: "Vec3,Hexahedron".
struct OverElements {
  std::string_view name, element, className, attribute, value;
};
inline constexpr std::array overElements = std::to_array<OverElements>(
    {{"CorotationalFEMForceField", "Hexahedron", "HexahedronFEMForceField", "method", "large"},
     {"CorotationalFEMForceField", "Tetrahedron", "TetrahedronFEMForceField", "method", "large"},
     {"CorotationalFEMForceField", "Prism", "PrismFEMForceField", "method", "polar"},
     {"CorotationalFEMForceField", "Pyramid", "PyramidFEMForceField", "method", "polar"},
     {"CorotationalFEMForceField",
      "QuadraticTetrahedron",
      "QuadraticTetrahedronFEMForceField",
      "method",
      "polar"},
     {"CorotationalFEMForceField",
      "QuadraticHexahedron",
      "QuadraticHexahedronFEMForceField",
      "method",
      "polar"},
     {"CorotationalFEMForceField",
      "TriquadraticHexahedron",
      "TriquadraticHexahedronFEMForceField",
      "method",
      "polar"},
     {"LinearSmallStrainFEMForceField", "Hexahedron", "HexahedronFEMForceField", "method", "small"},
     {"LinearSmallStrainFEMForceField", "Tetrahedron", "TetrahedronFEMForceField", "method", "small"},
     {"LinearSmallStrainFEMForceField", "Prism", "PrismFEMForceField", "method", "small"},
     {"LinearSmallStrainFEMForceField", "Pyramid", "PyramidFEMForceField", "method", "small"},
     {"LinearSmallStrainFEMForceField",
      "QuadraticTetrahedron",
      "QuadraticTetrahedronFEMForceField",
      "method",
      "small"},
     {"LinearSmallStrainFEMForceField",
      "QuadraticHexahedron",
      "QuadraticHexahedronFEMForceField",
      "method",
      "small"},
     {"LinearSmallStrainFEMForceField",
      "TriquadraticHexahedron",
      "TriquadraticHexahedronFEMForceField",
      "method",
      "small"},
     {"FEMMass", "Edge", "MeshMatrixMass", "elements", "edges"},
     {"FEMMass", "Triangle", "MeshMatrixMass", "elements", "triangles"},
     {"FEMMass", "Quad", "MeshMatrixMass", "elements", "quads"},
     {"FEMMass", "Tetrahedron", "MeshMatrixMass", "elements", "tetrahedra"},
     {"FEMMass", "Hexahedron", "MeshMatrixMass", "elements", "hexahedra"},
     {"FEMMass", "Prism", "MeshMatrixMass", "elements", "prisms"},
     {"FEMMass", "Pyramid", "MeshMatrixMass", "elements", "pyramids"},
     {"FEMMass", "QuadraticTetrahedron", "MeshMatrixMass", "elements", "quadraticTetrahedra"},
     {"FEMMass", "QuadraticHexahedron", "MeshMatrixMass", "elements", "quadraticHexahedra"},
     {"FEMMass", "TriquadraticHexahedron", "MeshMatrixMass", "elements", "triquadraticHexahedra"}});
constexpr bool is_over_elements(std::string_view tag) {
  for (auto const& o : overElements)
    if (o.name == tag) return true;
  return false;
}
/// How CorotationalFEMForceField finds rotations (rotationMethod), and what that is called here.
inline constexpr std::array rotationMethods =
    std::to_array<std::array<std::string_view, 2>>({{"triangle", "large"},
                                                    {"hexahedron", "large"},
                                                    {"polar", "polar"},
                                                    {"stable_polar", "polar"},
                                                    {"identity", "small"}});

/// Names that stand for a class which finds its answer in another way than SOFA's: what differs.
struct AnotherMethod {
  std::string_view name, difference;
};
inline constexpr std::array anotherMethod = std::to_array<AnotherMethod>(
    {{"AsyncSparseLDLSolver",
      "the matrix of each step is factorised before it is solved, as with SparseLDLSolver; SOFA goes on with "
      "the factorisation of an earlier step while a thread makes the next"},
     {"AugmentedLagrangianResponseConstraint",
      "contacts are those of FrictionContactConstraint, to which the iterations of SOFA's response converge; "
      "epsilon, the penalty of these, has no effect"},
     {"EigenSparseQR",
      "the matrix is factorised as L D L', as with SparseLDLSolver, and has to be symmetric"},
     {"EigenSparseLU",
      "the matrix is factorised as L D L', as with SparseLDLSolver, and has to be symmetric"},
     {"SparseLUSolver",
      "the matrix is factorised as L D L', as with SparseLDLSolver, and has to be symmetric"},
     {"TetrahedronCollisionModel",
      "it collides by its surface with all models, and keeps points and spheres out of its inside; SOFA "
      "tests it only by DiscreteIntersection, against points"},
     {"TetrahedronModel",
      "it collides by its surface with all models, and keeps points and spheres out of its inside; SOFA "
      "tests it only by DiscreteIntersection, against points"},
     {"SVDLinearSolver",
      "the matrix is factorised as L D L', and has to be symmetric and not singular; SOFA's takes the "
      "singular "
      "values of a full matrix"},
     {"WarpPreconditioner",
      "it rotates with the neighbourhood of each point, where SOFA's rotates with the rotations of a force "
      "field; the system is solved to the same tolerance"},
     {"PrecomputedWarpPreconditioner",
      "the factorisation of the first step rotates with the neighbourhood of each point, where SOFA's "
      "inverse rotates with the rotations of a force field; the system is solved to the same tolerance"}});
constexpr AnotherMethod const* another_method(std::string_view tag) {
  for (auto const& other : anotherMethod)
    if (other.name == tag) return &other;
  return nullptr;
}

/// Joints of articulated bodies, which are lists of their mapping: what holds all, one, and its axes.
inline constexpr std::array ofArticulations =
    std::to_array<std::string_view>({"ArticulatedHierarchyContainer", "ArticulationCenter", "Articulation"});

/// The implicit Euler solver of the first SOFA, which has its conjugate gradients in it.
inline constexpr std::array implicitWithCG =
    std::to_array<std::string_view>({"CGImplicit", "CGImplicitSolver", "CgImplicit", "CgImplicitSolver"});

/// What SOFA's NewtonRaphsonSolver says of the search where its element says nothing.
inline constexpr std::array newtonDefaults =
    std::to_array<std::array<std::string_view, 2>>({{"maxNbIterationsNewton", "1"},
                                                    {"relativeSuccessiveStoppingThreshold", "1e-5"},
                                                    {"relativeInitialStoppingThreshold", "1e-5"},
                                                    {"absoluteResidualStoppingThreshold", "1e-5"},
                                                    {"relativeEstimateDifferenceThreshold", "0"},
                                                    {"absoluteEstimateDifferenceThreshold", "0"},
                                                    {"maxNbIterationsLineSearch", "5"}});

/// Components that precondition, and linear solvers that may stand in their place: what a PCG solver that
/// links to them is told.
struct Preconditions {
  std::string_view name, precondition, updateStep;
  bool warp;  // it rotates with the body, and wraps another
};
inline constexpr std::array preconditioners =
    std::to_array<Preconditions>({{"JacobiPreconditioner", "jacobi", "", false},
                                  {"JacobiLinearSolver", "jacobi", "", false},
                                  {"BlockJacobiPreconditioner", "blockJacobi", "", false},
                                  {"SSORPreconditioner", "ssor", "", false},
                                  {"WarpPreconditioner", "ldl", "", true},
                                  {"PrecomputedWarpPreconditioner", "ldl", "0", true}});
constexpr Preconditions const* preconditioner_named(std::string_view tag) {
  for (auto const& p : preconditioners)
    if (p.name == tag) return &p;
  return nullptr;
}

/// Those of a MultigridLinearSolver that a solver with it as preconditioner has, too.
inline constexpr std::array multigridAttributes = std::to_array<std::string_view>(
    {"warp", "levels", "coarsestSize", "strengthThreshold", "smootherDegree", "coarseCycles"});

/// Attributes that are as good as not given where they are empty, or a link to nothing: "@".
inline constexpr std::array mayBeEmpty =
    std::to_array<std::string_view>({"src", "filename", "fileMesh", "fileTopology"});

/// Attributes of which SOFA reads as much as there should be, and passes over what comes behind it: here,
/// too, with a warning.
struct ReadInPart {
  std::string_view className, attribute;
};
inline constexpr std::array readInPart = std::to_array<ReadInPart>({{"MeshGmshLoader", "scale"},
                                                                    {"MeshOBJLoader", "scale"},
                                                                    {"MeshSTLLoader", "scale"},
                                                                    {"MeshVTKLoader", "scale"},
                                                                    {"UniformMass", "vertexMass"}});
constexpr bool is_read_in_part(std::string_view className, std::string_view attribute) {
  for (auto const& r : readInPart)
    if (r.className == className && r.attribute == attribute) return true;
  return false;
}
/// Lists that have as many entries as another one. SOFA passes over further ones, or, with `firstForAll`, has
/// the first entry for all where the numbers differ (BeamInterpolation.inl: checkDataSize): here, too, with a
/// warning.
struct AsManyAs {
  std::string_view className, list, other;
  bool firstForAll = false;
};
inline constexpr std::array asManyAs =
    std::to_array<AsManyAs>({{"LinearMovementConstraint", "movements", "keyTimes"},
                             {"BeamInterpolation", "radius", "edges", true},
                             {"BeamInterpolation", "innerRadius", "edges", true},
                             {"BeamInterpolation", "lengthY", "edges", true},
                             {"BeamInterpolation", "lengthZ", "edges", true},
                             {"BeamInterpolation", "defaultYoungModulus", "edges", true},
                             {"BeamInterpolation", "defaultPoissonRatio", "edges", true}});

template <class List>
constexpr bool has(List const& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}
/// Whether a list of a topology is taken by src: a TriangleSetTopologyContainer, say, has no tetrahedra.
inline bool container_holds(std::string_view tag, std::string_view list) {
  if (tag.find("SetTopologyContainer") == tag.npos || list == "position") return true;
  auto is = [&](std::string_view kind) { return tag.find(kind) != tag.npos; };
  if (list == "edges") return !is("PointSet");
  if (list == "triangles") return is("TriangleSet") || is("TetrahedronSet");
  if (list == "quads") return is("QuadSet") || is("HexahedronSet");
  if (list == "tetrahedra" || list == "quadraticTetrahedra") return is("TetrahedronSet");
  if (list == "pyramids" || list == "prisms") return false;
  const bool hexahedra =
      list == "hexahedra" || list == "quadraticHexahedra" || list == "triquadraticHexahedra";
  return !hexahedra || is("HexahedronSet");
}
inline bool class_without_meaning(std::string_view name) {
  if (has(withoutMeaning, name) || is_of_shader(name)) return true;
  return std::any_of(suffixesWithoutMeaning.begin(), suffixesWithoutMeaning.end(), [&](std::string_view end) {
    return name.ends_with(end);
  });
}

}  // namespace sinew::dialect
