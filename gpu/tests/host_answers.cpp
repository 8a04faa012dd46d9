// SPDX-License-Identifier: BSL-1.0
#include "host_answers.hpp"

#include <sinew/topology/regular_grid.hpp>

#include <random>

namespace gpu_test {

namespace {

template <class D>
typename D::Deriv random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> within(-size, size);
  typename D::Deriv r;
  for (int c = 0; c < D::size; ++c) r[c] = typename D::Real(within(random));
  return r;
}

template <int W, template <class> class LawOf, class D, class... Method>
Answer<D> with_lanes(Body<LawOf, D> const& body, Method... method) {
  using Real = typename D::Real;
  using Driver = ElementDriver<LawOf, D, W>;
  const typename Driver::Law law{method...};
  Driver driver;
  driver.init(body.elements, body.rest);
  Answer<D> answer{body.dx, body.v, 0};
  driver.addForce(law, answer.f, body.x, body.v);
  driver.addDForce(law, answer.df, body.dx, Real(0.7), Real(0.3));
  answer.energy = driver.energy(law, body.x);
  return answer;
}

}  // namespace

template <class D>
Body<SpringLaw, D> spring_network(int nodes, int springs) {
  using Real = typename D::Real;
  std::mt19937 random(1);
  Body<SpringLaw, D> body;
  for (int i = 0; i < nodes; ++i) {
    body.x.push_back(random_vector<D>(random, 1));
    body.v.push_back(random_vector<D>(random, 1));
    body.dx.push_back(random_vector<D>(random, 1));
  }
  body.x[1] = body.x[0];
  std::uniform_int_distribution<int> from(0, nodes - 2), step(1, nodes - 2);
  std::uniform_real_distribution<double> value(0.1, 1);
  for (int s = 0; s < springs; ++s) {
    const int a = from(random), b = (a + step(random)) % (nodes - 1);
    if (s == 0)
      body.elements.push_back({0, 1});
    else
      body.elements.push_back({a, b});
    body.rest.push_back({Real(100 * value(random)), Real(value(random)), Real(value(random))});
  }
  return body;
}

template <class D>
Body<TetrahedronFEM, D> tetrahedra(RotationMethod method) {
  using Real = typename D::Real;
  std::mt19937 random(2);
  const Mesh mesh = regular_grid_tetrahedra(5, 4, 3, {0, 0, 0}, {2, 1.5, 1});
  const double c = std::cos(1.0), s = std::sin(1.0);
  Body<TetrahedronFEM, D> body;
  auto at = [](auto const& positions, Tetrahedron const& t, std::size_t k) {
    auto const& p = positions[std::size_t(t[k])];
    return typename D::Coord(Real(p[0]), Real(p[1]), Real(p[2]));
  };
  for (Eigen::Vector3d const& p : mesh.positions) {
    const typename D::Coord turned(Real(c * p[0] - s * p[1]), Real(s * p[0] + c * p[1]), Real(p[2]));
    body.x.push_back(turned + random_vector<D>(random, 0.1));
    body.v.push_back(random_vector<D>(random, 1));
    body.dx.push_back(random_vector<D>(random, 1));
  }
  for (Tetrahedron const& t : mesh.tetrahedra) {
    typename D::Coord rest[4];
    for (std::size_t k = 0; k < 4; ++k) rest[k] = at(mesh.positions, t, k);
    body.elements.push_back(t);
    body.rest.push_back(TetrahedronFEM<D>::restOf(rest, Real(1000), Real(1500), method));
  }
  // the last element: point 3 through the plane of the others
  Tetrahedron const& last = body.elements.back();
  const typename D::Coord middle =
      (at(body.x, last, 0) + at(body.x, last, 1) + at(body.x, last, 2)) / Real(3);
  body.x[std::size_t(last[3])] = Real(2) * middle - at(body.x, last, 3);
  return body;
}

template <class D>
HostAnswers<D> on_host(Body<SpringLaw, D> const& body) {
  return {with_lanes<1>(body), with_lanes<native_width<typename D::Real>>(body)};
}
template <class D>
HostAnswers<D> on_host(Body<TetrahedronFEM, D> const& body, RotationMethod method) {
  return {with_lanes<1>(body, method), with_lanes<native_width<typename D::Real>>(body, method)};
}

template Body<SpringLaw, Vec3d> spring_network<Vec3d>(int, int);
template Body<SpringLaw, Vec3f> spring_network<Vec3f>(int, int);
template Body<TetrahedronFEM, Vec3d> tetrahedra<Vec3d>(RotationMethod);
template Body<TetrahedronFEM, Vec3f> tetrahedra<Vec3f>(RotationMethod);
template HostAnswers<Vec3d> on_host<Vec3d>(Body<SpringLaw, Vec3d> const&);
template HostAnswers<Vec3f> on_host<Vec3f>(Body<SpringLaw, Vec3f> const&);
template HostAnswers<Vec3d> on_host<Vec3d>(Body<TetrahedronFEM, Vec3d> const&, RotationMethod);
template HostAnswers<Vec3f> on_host<Vec3f>(Body<TetrahedronFEM, Vec3f> const&, RotationMethod);

}  // namespace gpu_test
