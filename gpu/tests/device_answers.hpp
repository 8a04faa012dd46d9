// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "host_answers.hpp"

#include <sinew/gpu/element_driver.hpp>

#include <thrust/fill.h>

namespace gpu_test {

template <class T>
std::vector<T> to_host(thrust::device_vector<T> const& v) {
  std::vector<T> host(v.size());
  thrust::copy(v.begin(), v.end(), host.begin());
  return host;
}

template <template <class> class LawOf, class D>
Answer<D> on_device(LawOf<D> const& law, Body<LawOf, D> const& body) {
  using Real = typename D::Real;
  gpu::ThrustElementDriver<LawOf, D> driver;
  driver.init(body.elements, body.rest, body.x.size());
  thrust::device_vector<typename D::Coord> x = body.x;
  thrust::device_vector<typename D::Deriv> v = body.v, dx = body.dx, f = body.dx, df = body.v;
  driver.addForce(law, f, x, v);
  driver.addDForce(law, df, dx, Real(0.7), Real(0.3));
  const double energy = driver.energy(law, x);
  return {to_host(f), to_host(df), energy};
}

/// One step of symplectic Euler for a point of unit mass: v += dt (f + g), x += dt v; f is then cleared.
template <class D>
struct EulerStep {
  typename D::Real dt, gravity;
  typename D::Deriv *f, *v;
  typename D::Coord* x;

  SINEW_HD void operator()(int i) const {
    f[i][1] += gravity;
    v[i] += dt * f[i];
    x[i] += dt * v[i];
    for (int c = 0; c < D::size; ++c) f[i][c] = 0;
  }
};

/// Where the points of a fall are after its steps on the device.
template <class D>
typename D::VecCoord fall_on_device(Fall<D> const& fall) {
  using Real = typename D::Real;
  Body<SpringLaw, D> const& body = fall.body;
  gpu::ThrustElementDriver<SpringLaw, D> driver;
  driver.init(body.elements, body.rest, body.x.size());
  thrust::device_vector<typename D::Coord> x = body.x;
  thrust::device_vector<typename D::Deriv> v = body.v, f(x.size(), D::Deriv::Zero());
  auto raw = [](auto& vector) { return thrust::raw_pointer_cast(vector.data()); };
  for (int step = 0; step < Fall<D>::steps; ++step) {
    driver.addForce({}, f, x, v);
    gpu::for_each_index(x.size(),
                        EulerStep<D>{Real(Fall<D>::dt), Real(Fall<D>::gravity), raw(f), raw(v), raw(x)});
  }
  return to_host(x);
}

}  // namespace gpu_test
