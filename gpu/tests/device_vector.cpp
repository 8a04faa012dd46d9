// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/gpu/device_vector.hpp>

namespace test_device_vector {

using namespace sinew;
using gpu::DeviceVector;
using Numbers = std::vector<double>;

namespace {

struct Add {
  double* v;
  double by;
  SINEW_HD void operator()(int i) const { v[i] += by; }
};
void add(DeviceVector<double>& v, double by) { gpu::for_each_index(v.size(), Add{v.device(), by}); }

struct Copy {
  double* to;
  double const* from;
  SINEW_HD void operator()(int i) const { to[i] = from[i]; }
};

// entries that have crossed since the last question, to the device and to the host
struct Crossed {
  std::size_t toDevice, toHost;
  bool operator==(Crossed const&) const = default;
};
Crossed crossed() {
  const Crossed now{gpu::transfers().toDevice, gpu::transfers().toHost};
  gpu::transfers() = {};
  return now;
}

}  // namespace

TEST_CASE("a side of a DeviceVector gets a copy when it asks, and only where the other has written") {
  crossed();
  DeviceVector<double> v{1, 2, 3};
  CHECK(crossed() == Crossed{0, 0});
  add(v, 10);
  CHECK(crossed() == Crossed{3, 0});
  add(v, 10);
  CHECK(crossed() == Crossed{0, 0});
  CHECK(std::as_const(v).host() == Numbers{21, 22, 23});
  CHECK(crossed() == Crossed{0, 3});
  // both sides have it now
  CHECK(std::as_const(v)[2] == 23);
  CHECK(std::as_const(v).device() != nullptr);
  CHECK(crossed() == Crossed{0, 0});
  v[1] = 5;
  CHECK(crossed() == Crossed{0, 0});
  add(v, 1);
  CHECK(crossed() == Crossed{3, 0});
  CHECK(v.host() == Numbers{22, 6, 24});
  CHECK(crossed() == Crossed{0, 3});
}

TEST_CASE("what is overwritten on the device does not cross before") {
  const DeviceVector<double> from{4, 5};
  DeviceVector<double> to(2, 1.0);
  double const* const source = from.device();
  crossed();
  gpu::for_each_index(2, Copy{to.overwrite(), source});
  CHECK(crossed() == Crossed{0, 0});
  CHECK(to == from);
  CHECK(crossed() == Crossed{0, 2});
}

TEST_CASE("a DeviceVector on its way to the host arrives as it was when nothing has written since") {
  DeviceVector<double> v{1, 2};
  v.bringToHost();  // nothing to bring: the host has it
  crossed();
  add(v, 1);
  v.bringToHost();
  CHECK(std::as_const(v).host() == Numbers{2, 3});
  CHECK(crossed() == Crossed{2, 2});
  // written again while it is on its way
  add(v, 1);
  v.bringToHost();
  add(v, 10);
  CHECK(v.host() == Numbers{13, 14});
  // moved, copied and assigned to on its way
  add(v, 1);
  v.bringToHost();
  DeviceVector<double> const copy = v;
  DeviceVector<double> moved = std::move(v);
  CHECK(copy.host() == Numbers{14, 15});
  CHECK(moved.host() == Numbers{14, 15});
  add(moved, 1);
  moved.bringToHost();
  DeviceVector<double> other{5, 6, 7};
  add(other, 1);
  moved = other;
  CHECK(moved.host() == Numbers{6, 7, 8});
  v = {};
  v.bringToHost();
  CHECK(v.host().empty());
}

TEST_CASE("copies of a DeviceVector are of the side that is newest, and independent") {
  DeviceVector<double> a{1, 2};
  crossed();
  DeviceVector<double> hostCopy = a;
  CHECK(crossed() == Crossed{0, 0});
  add(a, 1);
  crossed();
  DeviceVector<double> deviceCopy = a;
  CHECK(crossed() == Crossed{0, 0});
  add(deviceCopy, 10);
  CHECK(crossed() == Crossed{0, 0});
  CHECK(hostCopy.host() == Numbers{1, 2});
  CHECK(a.host() == Numbers{2, 3});
  CHECK(deviceCopy.host() == Numbers{12, 13});

  // onto one that is longer, and has been on the device
  DeviceVector<double> longer{7, 8, 9, 10};
  add(longer, 1);
  add(a, 1);
  longer = a;
  CHECK(longer.host() == Numbers{3, 4});
  longer = hostCopy;
  add(longer, 1);
  CHECK(longer.host() == Numbers{2, 3});
  DeviceVector<double> const& self = longer;
  longer = self;
  CHECK(longer.host() == Numbers{2, 3});
}

TEST_CASE("a DeviceVector that has been moved from is empty, and can be used") {
  DeviceVector<double> a{1, 2};
  add(a, 1);
  DeviceVector<double> b = std::move(a);
  CHECK(b.host() == Numbers{2, 3});
  CHECK(a.empty());
  CHECK(a.host().empty());
  a.push_back(4);
  add(a, 1);
  CHECK(a.host() == Numbers{5});
  a = std::move(b);
  CHECK(a.host() == Numbers{2, 3});
  CHECK(b.empty());
}

TEST_CASE("a DeviceVector changes its size as std::vector does, wherever it is") {
  DeviceVector<double> v(2, 3.0);
  add(v, 1);
  crossed();
  v.resize(2);
  CHECK(crossed() == Crossed{0, 0});
  v.resize(4, 9.0);
  CHECK(v.size() == 4);
  add(v, 1);
  CHECK(v.host() == Numbers{5, 5, 10, 10});
  add(v, 1);
  v.resize(3);
  CHECK(v.host() == Numbers{6, 6, 11});
  add(v, 1);
  v.push_back(1);
  CHECK(v.emplace_back(2.0) == 2);
  CHECK(v.host() == Numbers{7, 7, 12, 1, 2});
  add(v, 1);
  v.erase(v.begin(), v.begin() + 2);
  CHECK(v.size() == 3);
  CHECK(v.host() == Numbers{13, 2, 3});
  add(v, 1);
  CHECK(v.front() == 14);
  CHECK(v.back() == 4);
  add(v, 1);
  v.assign(std::size_t(2), 5.0);
  add(v, 1);
  CHECK(v.host() == Numbers{6, 6});
  add(v, 1);
  v.clear();
  CHECK(v.empty());
  CHECK(v.begin() == v.end());
  add(v, 1);
  CHECK(v.host().empty());
  v = {1, 2, 3};
  add(v, 1);
  double sum = 0;
  for (const double d : std::as_const(v)) sum += d;
  CHECK(sum == 9);
}

TEST_CASE("DeviceVectors without entries cross without a copy") {
  crossed();
  DeviceVector<double> none;
  none.device();
  none.host();
  DeviceVector<double> copy = none;
  copy.overwrite();
  CHECK(copy == none);
  CHECK(crossed() == Crossed{0, 0});
}

}  // namespace test_device_vector
