// SPDX-License-Identifier: BSL-1.0
// Springs and penalties on the device against the processor.
#include "agrees.hpp"
#include "samples_springs.hpp"

namespace test_drivers_springs {

using namespace gpu_test;

TEST_CASE("springs of a grid on the device equal those of the processor") {
  agrees<GridSprings, Vec3d>();
  agrees<GridSprings, Vec3f>();
}
TEST_CASE("penalties of a plane on the device equal those of the processor") {
  agrees<PenaltyPlane, Vec3d>();
  agrees<PenaltyPlane, Vec3f>();
}
TEST_CASE("penalties of a sphere on the device equal those of the processor") {
  agrees<PenaltySphere, Vec3d>();
  agrees<PenaltySphere, Vec3f>();
}
TEST_CASE("springs on the device move freely as a whole") {
  moves_freely<GridSprings, Vec3d>(0);
  moves_freely<GridSprings, Vec3f>(0);
}

TEST_CASE("forces of a spring computed by hand, on the device") {
  // 2 m long, at rest 1.5 m, 100 N/m, 3 N s/m, its ends part with 4 m/s along it
  using D = CudaVec3d;
  using Vectors = std::vector<Eigen::Vector3d>;
  ElementDriver<SpringLaw, D> driver;
  driver.init({{2, 0}}, {{100, 3, 1.5}});
  const D::VecCoord x{{3, 1, 1}, {9, 9, 9}, {1, 1, 1}, {0, 0, 0}};
  const D::VecDeriv v{{4, 5, 0}, {1, 1, 1}, {0, 5, 0}, {0, 0, 0}};
  D::VecDeriv f{{0, 1, 0}, {7, 7, 7}, {0, 0, 2}, {3, 3, 3}}, df(4, {0, 0, 0});
  driver.addForce({}, f, x, v);
  CHECK(f.host() == Vectors{{-62, 1, 0}, {7, 7, 7}, {62, 0, 2}, {3, 3, 3}});
  CHECK(driver.energy({}, x) == 12.5);
  driver.addDForce({}, df, x, 1, 0);  // along the axis the stiffness is that of the spring
  CHECK(df[0][0] == Approx(-200));
  CHECK(df[2][0] == Approx(200));
}

TEST_CASE("springs between two bodies on the device equal those of the processor") {
  const Motion<Vec3d> a(0.1), b(0.3);
  auto answer = [&]<class D>(D) {
    ElementDriver<SpringLaw, D> driver;
    std::vector<std::array<int, 2>> elements;
    std::vector<typename SpringLaw<D>::Rest> rest;
    for (int s = 0; s < 200; ++s) {
      elements.push_back({(s * 7) % 60, (s * 11 + 3) % 50});  // not all points of the second
      rest.push_back({100 + noise(std::size_t(s)), 2, 0.5});
    }
    driver.init(elements, rest);
    const typename D::VecCoord xa(a.x), xb(b.x);
    const typename D::VecDeriv va(a.v), vb(b.v), da(a.dx), db(b.dx);
    typename D::VecDeriv fa(a.dx), fb(b.v), ka(a.v), kb(b.dx);
    driver.addForce({}, {entries(fa), entries(fb)}, {entries(xa), entries(xb)}, {entries(va), entries(vb)});
    for (int k = 0; k < 2; ++k)
      driver.addDForce({}, {entries(ka), entries(kb)}, {entries(da), entries(db)}, 0.7, 0.3);
    const double energy = driver.energy({}, typename decltype(driver)::Coords{entries(xa), entries(xb)});
    return std::array<Answer<Vec3d>, 2>{
        {{on_the_host(fa), on_the_host(ka), {}, {}, energy}, {on_the_host(fb), on_the_host(kb), {}, {}, 1}}};
  };
  const auto host = answer(Vec3d{}), device = answer(CudaVec3d{}), again = answer(CudaVec3d{});
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(relative_difference(device[k].f, host[k].f) < rounding<double>);
    CHECK(relative_difference(device[k].first, host[k].first) < rounding<double>);
    CHECK(device[k].energy == Approx(host[k].energy).epsilon(rounding<double>));
    CHECK(again[k] == device[k]);
  }
}

TEST_CASE("a driver on the device without elements adds nothing") {
  ElementDriver<SpringLaw, CudaVec3d> driver;
  driver.init({}, {});
  const CudaVec3d::VecCoord x(2, {1, 2, 3});
  CudaVec3d::VecDeriv f = x;
  driver.addForce({}, f, x, x);
  driver.addDForce({}, f, x, 1, 1);
  CHECK(f == x);
  CHECK(driver.energy({}, x) == 0);
  CHECK(driver.removeIf([](auto const&) { return true; }) == 0);
}

}  // namespace test_drivers_springs
