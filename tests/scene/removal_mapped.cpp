// SPDX-License-Identifier: BSL-1.0
// What follows a removal through mappings, attachments and beams.
#include "removal_row.hpp"

namespace test_removal_mapped {

using namespace removal;

TEST_CASE("lengths and volumes go with their edges and tetrahedra, and the centre of mass moves") {
  using Lengths = DistanceMapping<Vec3d, Vec1d>;
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{},
      node<"body">(TetrahedronTopology{tetrahedra()},
                   MechanicalObject<Vec3d>{.position = row()},
                   DiagonalMass<Vec3d>{.massDensity = 1},
                   node<"sides">(MechanicalObject<Vec1d>{}, Lengths{}),
                   node<"wires">(MeshTopology{.edges = {{0, 5}, {1, 5}, {2, 5}}},
                                 MechanicalObject<Vec1d>{},
                                 Lengths{.restLengths = {1, 2, 3}}),
                   node<"volumes">(MechanicalObject<Vec1d>{}, VolumeMapping<Vec3d, Vec1d>{}),
                   node<"centre">(MechanicalObject<Vec3d>{}, CenterOfMassMapping<Vec3d, Vec3d>{})))};
  sim.init();
  auto& sides = sim.at<"body/sides">();
  auto& volumes = sim.at<"body/volumes">();
  CHECK(sides.state().size() == 12);  // 6 of the first, 3 more of each other
  const double second = volumes.state().position[1][0];
  sim.removeElements("body", {.tetrahedra = {0}});
  CHECK(sides.state().size() == 9);
  CHECK(volumes.state().size() == 2);
  CHECK(volumes.state().position[0][0] == Approx(second).epsilon(1e-14));
  auto& wires = sim.at<"body/wires">();
  CHECK(wires.get<MeshTopology>().edges == std::vector<Edge>{{0, 4}, {1, 4}});
  CHECK(wires.get<Lengths>().restLengths == std::vector<double>{2, 3});
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  auto const& masses = sim.at<"body">().get<DiagonalMass<Vec3d>>().lumped.mass;
  double whole = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    centre += masses[i] * sim.at<"body">().state().position[i];
    whole += masses[i];
  }
  CHECK((sim.at<"body/centre">().state().position[0] - centre / whole).norm() < 1e-14);
  sim.animate(0.01);
}

TEST_CASE("attached points and listed beams go with what they refer to") {
  using Attach = AttachProjectiveConstraint<Vec3d, Between<"body", "other">>;
  std::vector<Rigid3d::Coord> frames;
  for (int i = 0; i < 4; ++i) frames.push_back({{double(i), 0, 0}, Eigen::Quaterniond::Identity()});
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{},
      node<"body">(TetrahedronTopology{tetrahedra()},
                   MechanicalObject<Vec3d>{.position = row()},
                   UniformMass<Vec3d>{}),
      node<"other">(MechanicalObject<Vec3d>{.position = {row()[0], row()[4]}}, UniformMass<Vec3d>{}),
      Attach{.indices1 = {0, 4}, .indices2 = {0, 1}, .constraintFactor = {1, 1}},
      node<"beams">(MeshTopology{.edges = {{0, 1}, {1, 2}, {2, 3}}},
                    MechanicalObject<Rigid3d>{.position = frames},
                    UniformMass<Rigid3d>{},
                    BeamFEMForceField<Rigid3d>{.listSegment = {0, 2}}))};
  sim.init();
  sim.removeElements("body", {.tetrahedra = {0}});
  CHECK(sim.root().get<Attach>().indices1 == std::vector<int>{3});
  CHECK(sim.root().get<Attach>().indices2 == std::vector<int>{1});
  sim.removeElements("beams", {.edges = {0}});
  auto& beams = sim.at<"beams">();
  CHECK(beams.state().size() == 3);
  CHECK(beams.get<BeamFEMForceField<Rigid3d>>().listSegment == std::vector<int>{1});
  sim.removeElements("beams", {.edges = {1}});
  CHECK(beams.state().size() == 2);
  CHECK(beams.get<BeamFEMForceField<Rigid3d>>().none);
  CHECK(beams.get<BeamFEMForceField<Rigid3d>>().driver.packs.empty());
  sim.animate(0.01);
}

TEST_CASE("of a state with several parents what was mapped from a point that goes") {
  using Both = SubsetMultiMapping<Vec3d, Vec3d, Parents<"../body", "../other">>;
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{},
      node<"body">(TetrahedronTopology{tetrahedra()},
                   MechanicalObject<Vec3d>{.position = row()},
                   UniformMass<Vec3d>{}),
      node<"other">(MechanicalObject<Vec3d>{.position = {{0, 0, 3}, {1, 0, 3}}}, UniformMass<Vec3d>{}),
      node<"both">(MeshTopology{.edges = {{0, 1}, {1, 2}, {2, 3}}},
                   MechanicalObject<Vec3d>{},
                   Both{.indexPairs = {{1, 1}, {0, 0}, {0, 4}, {1, 0}}},
                   MeshSpringForceField<Vec3d>{.stiffness = 1}))};
  sim.init();
  sim.removeElements("body", {.tetrahedra = {0}});
  auto& both = sim.at<"both">();
  CHECK(both.get<Both>().indexPairs == std::vector<std::array<int, 2>>{{1, 1}, {0, 3}, {1, 0}});
  CHECK(both.get<MeshTopology>().edges == std::vector<Edge>{{1, 2}});
  CHECK(both.state().position[1] == sim.at<"body">().state().position[3]);
  sim.animate(0.01);
}

TEST_CASE("a skin loses the weights of the frames that go, and the points that have no other") {
  using Skin = SkinningMapping<Rigid3d, Vec3d>;
  std::vector<Rigid3d::Coord> frames;
  for (int i = 0; i < 4; ++i) frames.push_back({{double(i), 0, 0}, Eigen::Quaterniond::Identity()});
  const std::vector<Eigen::Vector3d> points{{0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{},
      node<"beams">(
          MeshTopology{.edges = {{0, 1}, {1, 2}, {2, 3}}},
          MechanicalObject<Rigid3d>{.position = frames},
          UniformMass<Rigid3d>{},
          node<"given">(
              MechanicalObject<Vec3d>{.position = points},
              Skin{.nbRef = {1, 2, 2}, .indices = {0, 0, 1, 1, 2}, .weight = {1, 0.5, 0.5, 0.25, 0.75}}),
          node<"nearest">(MechanicalObject<Vec3d>{.position = points}, Skin{.nbRef = {2}})))};
  sim.init();
  sim.removeElements("beams", {.edges = {0}});
  auto& given = sim.at<"beams/given">();
  CHECK(given.state().position == std::vector<Eigen::Vector3d>{points[1], points[2]});
  CHECK(given.get<Skin>().nbRef == std::vector<int>{1, 2});
  CHECK(given.get<Skin>().indices == std::vector<int>{0, 0, 1});
  CHECK(given.get<Skin>().weight == std::vector<double>{0.5, 0.25, 0.75});
  CHECK(sim.at<"beams/nearest">().state().position.size() == 3);
  sim.animate(0.01);
}

}  // namespace test_removal_mapped
