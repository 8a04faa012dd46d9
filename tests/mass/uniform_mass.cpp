// SPDX-License-Identifier: BSL-1.0
#include "io/files.hpp"
#include "one_component.hpp"

#include <sinew/io/write_obj.hpp>
#include <sinew/mass/uniform_mass.hpp>

namespace test_uniform_mass {

using namespace sinew;
using Eigen::Vector3d;
using one::ready;
using one::refuses;

namespace {

using Mass3 = UniformMass<Rigid3d>;
const Rigid3d::VecCoord two(2);

Mesh box(Vector3d const& size, Vector3d const& center = Vector3d::Zero()) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.positions.push_back(center + size.cwiseProduct(Vector3d(k % 2 - 0.5, k / 2 % 2 - 0.5, k / 4 - 0.5)));
  mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

}  // namespace

TEST_CASE("bodies take their mass from a file of SOFA's") {
  const files::TempFolder folder;
  const std::string file = folder.write("a.rigid", "Xsp 3.0\nmass 4\ninrt 1 0 0 0 2 0 0 0 3\n");
  const auto mass = ready(Mass3{.filename = {file}}, two);
  CHECK(mass.lumped.at(1).mass == 4);
  CHECK((mass.lumped.at(1).inertia - Eigen::Matrix3d(Vector3d(4, 8, 12).asDiagonal())).norm() < 1e-14);
  // a total of 1 kg for two bodies
  const auto total = ready(Mass3{.totalMass = 1, .filename = {file}}, two);
  CHECK(total.lumped.at(0).mass == 0.5);
  CHECK((total.lumped.at(0).inertia - Eigen::Matrix3d(Vector3d(0.5, 1, 1.5).asDiagonal())).norm() < 1e-15);
  // in single precision too; and nothing has changed for those without a file
  CHECK(ready(UniformMass<Rigid3f>{.filename = {file}}, Rigid3f::VecCoord(1)).lumped.at(0).mass == 4);
  CHECK(ready(Mass3{}, two).lumped.at(0).inertia == Eigen::Matrix3d::Identity());
  CHECK(ready(Mass3{.totalMass = 3}, two).lumped.at(0).inertia == 1.5 * Eigen::Matrix3d::Identity());
}

TEST_CASE("bodies take their inertia from a closed surface") {
  const files::TempFolder folder;
  const Vector3d size(1, 2, 3);
  io::write_obj(folder / "box.obj", box(size));
  const auto mass = ready(Mass3{.filename = {folder / "box.obj"}}, two);
  CHECK(mass.lumped.at(0).mass == 1);
  const Eigen::Matrix3d perMass = Vector3d((4 + 9) / 12., (1 + 9) / 12., (1 + 4) / 12.).asDiagonal();
  CHECK((mass.lumped.at(0).inertia - perMass).norm() < 1e-14);
  // turning about z with w has the energy m w^2 (x^2 + y^2) / 24
  Rigid3d::VecDeriv v(2, Rigid3d::Deriv::Zero());
  v[1][5] = 3;
  CHECK(mass.kineticEnergy(two, v) == Approx(0.5 * 9 * 5. / 12));
  const auto total = ready(Mass3{.totalMass = 8, .filename = {folder / "box.obj"}}, two);
  CHECK((total.lumped.at(0).inertia - 4 * perMass).norm() < 1e-13);
  // a thousandth of its size off the origin is let pass
  io::write_obj(folder / "near.obj", box(size, {0.001, 0, 0}));
  CHECK((ready(Mass3{.filename = {folder / "near.obj"}}, two).lumped.at(0).inertia - perMass).norm() < 1e-14);
}

TEST_CASE("files that tell no inertia are refused") {
  const files::TempFolder folder;
  const std::string rigid = folder.write("a.rigid", "Xsp 3.0\nmass 4\n");
  refuses(Mass3{.vertexMass = RigidMass<double, 3>{}, .filename = {rigid}},
          two,
          {},
          {"body", "UniformMass<Rigid3d>", "vertexMass and filename are both given"});
  refuses(Mass3{.filename = {folder / "none.rigid"}},
          two,
          {},
          {"UniformMass<Rigid3d>", "none.rigid", "No such file"});
  refuses(Mass3{.filename = {folder.write("bad.rigid", "Xsp 3.0\nmass x\n")}},
          two,
          {},
          {"bad.rigid:2", "a mass"});
  refuses(Mass3{.filename = {folder.write("flat.rigid", "Xsp 3.0\ninrt 1 0 0 0 1 0 0 0 0")}},
          two,
          {},
          {"symmetric and positive definite"});
  refuses(Mass3{.filename = {folder.write("a.txt", "Xsp 3.0\n")}}, two, {}, {"a.txt", ".txt", ".rigid"});
  io::write_obj(folder / "far.obj", box({1, 1, 1}, {0.5, 0, 0}));
  refuses(Mass3{.filename = {folder / "far.obj"}},
          two,
          {},
          {"far.obj", "centre of mass is at (0.5, ", "GenerateRigidMass"});
  Mesh open = box({1, 1, 1});
  open.quads.pop_back();
  io::write_obj(folder / "open.obj", open);
  refuses(Mass3{.filename = {folder / "open.obj"}}, two, {}, {"open.obj", "not closed"});
}

}  // namespace test_uniform_mass
