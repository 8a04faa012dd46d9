// SPDX-License-Identifier: BSL-1.0
// Mappings with an end, or both, on the device, against the same between states of the host.
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace test_mappings {

using namespace sinew;

namespace {

template <class D>
struct HostOf {
  using type = D;
};
template <class H>
struct HostOf<CudaTypes<H>> {
  using type = H;
};
template <class D>
using Host = typename HostOf<D>::type;

// numbers without a pattern, the same each time
struct Numbers {
  unsigned state = 12345;
  double operator()() {
    state = state * 1664525u + 1013904223u;
    return double(state) / 2147483648.0 - 1;
  }
};

template <class D>
std::vector<typename D::Coord> coords(std::size_t n, Numbers& next) {
  std::vector<typename D::Coord> x;
  for (std::size_t i = 0; i < n; ++i) {
    typename D::Deriv move;
    for (int c = 0; c < D::size; ++c) move[c] = typename D::Real(next());
    x.push_back(D::zero());
    D::increment(x.back(), move);
  }
  return x;
}
template <class D>
std::vector<typename D::Deriv> derivs(std::size_t n, Numbers& next) {
  std::vector<typename D::Deriv> v(n);
  for (auto& entry : v)
    for (int c = 0; c < D::size; ++c) entry[c] = typename D::Real(next());
  return v;
}

template <class A, class B>
double largest_difference(A const& a, B const& b) {
  REQUIRE(a.size() == b.size());
  double maximum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if constexpr (requires { a[i].center; })
      maximum = std::max({maximum,
                          double((a[i].center - b[i].center).norm()),
                          double((a[i].orientation.coeffs() - b[i].orientation.coeffs()).norm())});
    else
      maximum = std::max(maximum, double((a[i] - b[i]).norm()));
  return maximum;
}

// bytes that cross between host and device are counted in entries
std::size_t crossed() {
  const auto count = gpu::transfers();
  return count.toDevice + count.toHost;
}

// A mapping over (In, Out), and the same over their twins on the host: x is the parent at rest, and y the
// child. The work of all forces is the same on both sides: <J u, w> = <u, J' w>. In one apply or applyJ
// exactly `perVector` entries cross.
template <template <class, class> class M, class In, class Out, class Prepare>
void agrees(std::vector<typename In::Coord> const& x, std::vector<typename Out::Coord> const& y,
            TopologyView const& topology, std::size_t perVector, Prepare const& prepare) {
  INFO((component_name<M<In, Out>>()) << ", " << x.size() << " to " << y.size() << " points");
  using HI = Host<In>;
  using HO = Host<Out>;
  // of sums of a few hundred numbers near 1
  const double rounding = sizeof(typename In::Real) == 8 && sizeof(typename Out::Real) == 8 ? 1e-13 : 2e-5;
  Numbers next;
  M<HI, HO> host;
  M<In, Out> device;
  prepare(host);
  prepare(device);
  typename HI::VecCoord hx = x;
  typename HO::VecCoord hy = y;
  typename In::VecCoord dx(x);
  typename Out::VecCoord dy(y);
  host.init(InitContext<HI>{"parent", typename HI::VecCoord(x), topology},
            InitContext<HO>{"child", typename HO::VecCoord(y), {}},
            hy);
  device.init(InitContext<In>{"parent", typename In::VecCoord(x), topology},
              InitContext<Out>{"child", typename Out::VecCoord(y), {}},
              dy);
  const auto moved = coords<HI>(x.size(), next);
  hx = moved;
  dx = typename In::VecCoord(moved);
  const auto u = derivs<HI>(x.size(), next), jtw = derivs<HI>(x.size(), next);
  const auto w = derivs<HO>(hy.size(), next);
  typename HI::VecDeriv hu = u, hf = jtw;
  typename HO::VecDeriv hv(w.size()), hw = w;
  typename In::VecDeriv du(u), df(jtw);
  typename Out::VecDeriv dv(w), dw(w);

  host.apply(hy, hx);
  device.apply(dy, dx);
  CHECK(largest_difference(dy, hy) < rounding);
  host.applyJ(hv, hu);
  device.applyJ(dv, du);
  CHECK(largest_difference(dv, hv) < rounding);
  host.applyJT(hf, hw);
  device.applyJT(df, dw);
  CHECK(largest_difference(df, hf) < 20 * rounding);
  double above = 0, below = 0;
  for (std::size_t i = 0; i < u.size(); ++i) above += double(u[i].dot(df[i] - jtw[i]));
  for (std::size_t i = 0; i < w.size(); ++i) below += double(dv[i].dot(w[i]));
  CHECK(above == Approx(below).margin(200 * rounding));

  // the same bits again, and no more transfers than have to be; vectors where their DataTypes have them
  const auto first = std::vector(df.begin(), df.end());
  df = typename In::VecDeriv(jtw);
  auto use = [](auto& v) { entries(v); };
  use(dx), use(dy), use(du), use(dv), use(dw), use(df);
  gpu::transfers() = {};
  device.apply(dy, dx);
  device.applyJ(dv, du);
  use(dy), use(dv);
  CHECK(crossed() == 2 * perVector);
  device.applyJT(df, dw);
  use(df);
  CHECK(crossed() == 3 * perVector);
  const auto second = std::vector(df.begin(), df.end());
  CHECK(std::equal(first.begin(), first.end(), second.begin()));
}
template <template <class, class> class M, class In, class Out>
void agrees(std::vector<typename In::Coord> const& x, std::vector<typename Out::Coord> const& y,
            TopologyView const& topology, std::size_t perVector) {
  agrees<M, In, Out>(x, y, topology, perVector, [](auto&) {});
}
template <class In, class Out>
constexpr bool across = OnDevice<In> != OnDevice<Out>;

template <class In, class Out>
void identity() {
  Numbers next;
  const auto x = coords<Host<In>>(300, next);
  agrees<IdentityMapping, In, Out>(x, coords<Host<Out>>(300, next), {}, across<In, Out> ? 300 : 0);
}
// fewer points than the parent, and more, with points that several follow
template <class In, class Out>
void subset() {
  for (const std::size_t n : {60u, 900u}) {
    Numbers next;
    const auto x = coords<Host<In>>(300, next);
    const auto y = coords<Host<Out>>(n, next);
    agrees<SubsetMapping, In, Out>(
        x, y, {}, across<In, Out> ? std::min<std::size_t>(n, 300) : 0, [&](auto& m) {
          for (std::size_t i = 0; i < n; ++i) m.indices.push_back(int(i * 7919 % 211));
        });
  }
}
// in tetrahedra, and in hexahedra, of a grid of 5 x 4 x 4 points
template <class In, class Out>
void barycentric() {
  Mesh tetrahedra = regular_grid_tetrahedra(5, 4, 4, {-1, -1, -1}, {1, 1, 1}), hexahedra;
  hexahedra.positions = tetrahedra.positions;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) {
        auto at = [](int a, int b, int c) { return a + 5 * (b + 4 * c); };
        hexahedra.hexahedra.push_back({at(i, j, k),
                                       at(i + 1, j, k),
                                       at(i + 1, j + 1, k),
                                       at(i, j + 1, k),
                                       at(i, j, k + 1),
                                       at(i + 1, j, k + 1),
                                       at(i + 1, j + 1, k + 1),
                                       at(i, j + 1, k + 1)});
      }
  std::vector<typename In::Coord> x;
  for (auto const& p : tetrahedra.positions) x.push_back(p.template cast<typename In::Real>());
  for (const std::size_t n : {20u, 700u}) {
    Numbers next;
    const auto y = coords<Host<Out>>(n, next);
    const std::size_t crossing = across<In, Out> ? std::min<std::size_t>(n, 80) : 0;
    TopologyView inTetrahedra, inHexahedra;
    inTetrahedra.tetrahedra = tetrahedra.tetrahedra;
    inHexahedra.hexahedra = hexahedra.hexahedra;
    agrees<BarycentricMapping, In, Out>(x, y, inTetrahedra, crossing);
    agrees<BarycentricMapping, In, Out>(x, y, inHexahedra, crossing);
  }
}
// one body with 1,000 points, and 7 bodies of which one carries nothing
template <class In, class Out>
void rigid() {
  for (const std::size_t bodies : {1u, 7u}) {
    Numbers next;
    const auto x = coords<Host<In>>(bodies, next);
    const auto y = coords<Host<Out>>(1000, next);
    agrees<RigidMapping, In, Out>(x, y, {}, across<In, Out> ? bodies : 0, [&](auto& m) {
      if (bodies == 1) return;
      m.rigidIndices.clear();
      for (int i = 0; i < 1000; ++i) m.rigidIndices.push_back(i * 31 % 6);
    });
  }
}

}  // namespace

TEST_CASE("mapping points to points on the device equals that on the host") {
  identity<CudaVec3d, CudaVec3d>();
  identity<CudaVec3d, CudaVec3f>();
  subset<CudaVec3d, CudaVec3d>();
  subset<CudaVec3f, CudaVec3d>();
  barycentric<CudaVec3d, CudaVec3d>();
  barycentric<CudaVec3f, CudaVec3f>();
}

TEST_CASE("mapping between host and device equals that on the host, and the fewer points cross") {
  identity<CudaVec3d, Vec3d>();
  identity<CudaVec3d, Vec3f>();
  identity<Vec3f, CudaVec3f>();
  subset<CudaVec3d, Vec3d>();
  subset<CudaVec3f, Vec3f>();
  subset<Vec3d, CudaVec3d>();
  barycentric<CudaVec3d, Vec3f>();
  barycentric<CudaVec3f, Vec3d>();
  barycentric<Vec3d, CudaVec3d>();
}

TEST_CASE("points on rigid bodies of the device equal those on the host") {
  identity<CudaRigid3d, CudaRigid3f>();
  identity<CudaRigid3d, CudaVec3d>();
  identity<CudaRigid3d, Vec3d>();
  rigid<CudaRigid3d, CudaVec3d>();
  rigid<CudaRigid3f, CudaVec3f>();
  rigid<CudaRigid3d, CudaRigid3d>();
}

TEST_CASE("points on rigid bodies across host and device equal those on the host, and bodies cross") {
  rigid<CudaRigid3d, Vec3f>();
  rigid<CudaRigid3d, Vec3d>();
  rigid<Rigid3d, CudaVec3d>();
}

TEST_CASE("forces of zero on a child of the host do not cross") {
  const Vec3d::VecCoord x(50, Eigen::Vector3d(1, 2, 3));
  IdentityMapping<CudaVec3d, Vec3d> mapping;
  Vec3d::VecCoord child;
  const CudaVec3d::VecCoord parent(x);
  mapping.init({"parent", parent, {}}, {"child", x, {}}, child);
  CudaVec3d::VecDeriv f(50, Eigen::Vector3d(1, 0, 0));
  entries(f);
  gpu::transfers() = {};
  mapping.applyJT(f, Vec3d::VecDeriv(50, Eigen::Vector3d::Zero()));
  CHECK(crossed() == 0);
}

}  // namespace test_mappings
