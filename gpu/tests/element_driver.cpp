// SPDX-License-Identifier: BSL-1.0
// The Thrust driver on a backend of the host, CPP or OMP.
#include "catch.hpp"

#include "device_answers.hpp"

#if defined(_OPENMP)
#include <omp.h>
#endif

using namespace gpu_test;

namespace {

template <template <class> class LawOf, class D, class... Method>
void agrees(Body<LawOf, D> const& body, Method... method) {
  const LawOf<D> law{method...};
  const Answer<D> device = on_device(law, body);
  const HostAnswers<D> host = on_host(body, method...);
  CHECK(relative_difference(device, host.scalar) < rounding<typename D::Real>);
  CHECK(relative_difference(device, host.lanes) < rounding<typename D::Real>);
  CHECK(on_device(law, body) == device);
#if defined(_OPENMP)
  const int threads = omp_get_max_threads();
  for (const int n : {1, 2, 3, 7}) {
    omp_set_num_threads(n);
    CHECK(on_device(law, body) == device);
  }
  omp_set_num_threads(threads);
#endif
}

using Springs = gpu::ThrustElementDriver<SpringLaw, Vec3d>;

}  // namespace

TEMPLATE_TEST_CASE("springs on Thrust's device equal the CPU driver's", "", Vec3d, Vec3f) {
  agrees(spring_network<TestType>(700, 6001));
  agrees(spring_network<TestType>(5, 3));
}

TEMPLATE_TEST_CASE("tetrahedra on Thrust's device equal the CPU driver's", "", Vec3d, Vec3f) {
  for (std::size_t m = 0; m < 4; ++m) {
    INFO(enum_names(RotationMethod{})[m]);
    agrees(tetrahedra<TestType>(RotationMethod(m)), RotationMethod(m));
  }
}

TEMPLATE_TEST_CASE("symplectic Euler on Thrust's device equals the Simulation", "", Vec3d, Vec3f) {
  const Fall<TestType> fall = falling_springs<TestType>();
  CHECK(fall.strain() > 0.05);  // the springs had work to do
  CHECK(relative_difference(fall_on_device(fall), fall.after) < 10 * rounding<typename TestType::Real>);
}

TEST_CASE("forces of a spring computed by hand, on Thrust's device") {
  // 2 m long, at rest 1.5 m, 100 N/m, 3 N s/m, its ends part with 4 m/s along it
  Springs driver;
  driver.init({{2, 0}}, {{100, 3, 1.5}}, 3);
  using Vectors = std::vector<Eigen::Vector3d>;
  const thrust::device_vector<Eigen::Vector3d> x = Vectors{{3, 1, 1}, {9, 9, 9}, {1, 1, 1}},
                                               v = Vectors{{4, 5, 0}, {1, 1, 1}, {0, 5, 0}};
  thrust::device_vector<Eigen::Vector3d> f = Vectors{{0, 1, 0}, {7, 7, 7}, {0, 0, 2}}, df(3, {0, 0, 0});
  driver.addForce({}, f, x, v);
  CHECK(to_host(f) == Vectors{{-62, 1, 0}, {7, 7, 7}, {62, 0, 2}});
  CHECK(driver.energy({}, x) == 12.5);
  driver.addDForce({}, df, x, 1, 0);  // along the axis the stiffness is that of the spring
  CHECK(to_host(df)[0][0] == Approx(-200));
  CHECK(to_host(df)[2][0] == Approx(200));
  CHECK(driver.size() == 1);
  CHECK(driver.nodeCount() == 3);
}

TEST_CASE("a Thrust driver without elements adds nothing") {
  Springs driver;
  driver.init({}, {}, 2);
  const thrust::device_vector<Eigen::Vector3d> x(2, {1, 2, 3});
  thrust::device_vector<Eigen::Vector3d> f = x;
  driver.addForce({}, f, x, x);
  driver.addDForce({}, f, x, 1, 1);
  CHECK(to_host(f) == to_host(x));
  CHECK(driver.energy({}, x) == 0);
}

TEST_CASE("a Thrust driver says what is wrong with its input") {
  Springs driver;
  const Springs::Rest rest{1, 0, 1};
  auto message = [](auto&& action) -> std::string {
    try {
      action();
    } catch (Error const& error) {
      return error.what();
    }
    return "nothing";
  };
  CHECK(message([&] {
          driver.init({{0, 1}, {1, 2}}, {rest, rest}, 2);
        }) ==
        "ThrustElementDriver::init: element 1 refers to node 2, but there are 2 nodes, numbered from 0; "
        "correct the index");
  CHECK(message([&] {
          driver.init({{-1, 1}}, {rest}, 2);
        }) ==
        "ThrustElementDriver::init: element 0 refers to node -1, but there are 2 nodes, numbered from 0; "
        "correct the index");
  CHECK(message([&] {
          driver.init({{0, 1}}, {rest, rest}, 2);
        }) == "ThrustElementDriver::init: 2 rest data were given for 1 elements; give one for each element");
  CHECK(message([&] {
          driver.init({{0, 1}}, {rest}, std::size_t(1) << 31);
        }) ==
        "ThrustElementDriver::init: 1 elements over 2147483648 nodes exceed the 2^31 - 1 numbers of an int; "
        "split the body");
  CHECK(driver.size() == 0);

  driver.init({{0, 1}}, {rest}, 2);
  const thrust::device_vector<Eigen::Vector3d> two(2, {0, 0, 0}), three(3, {0, 0, 0});
  thrust::device_vector<Eigen::Vector3d> f2 = two, f3 = three;
  CHECK(message([&] { driver.addForce({}, f3, two, two); }) ==
        "ThrustElementDriver::addForce: f has 3 entries, but init was given 2 nodes; pass vectors with one "
        "entry a node");
  CHECK(message([&] { driver.addForce({}, f2, three, two); }).find("x has 3 entries") != std::string::npos);
  CHECK(message([&] { driver.addForce({}, f2, two, three); }).find("v has 3 entries") != std::string::npos);
  CHECK(message([&] { driver.addDForce({}, f3, two, 1, 0); }).find("df has 3 entries") != std::string::npos);
  CHECK(message([&] { driver.addDForce({}, f2, three, 1, 0); }).find("dx has 3 entries") !=
        std::string::npos);
  CHECK(message([&] { driver.energy({}, three); }).find("x has 3 entries") != std::string::npos);
}
