// SPDX-License-Identifier: BSL-1.0
// Times addForce and addDForce of the Thrust driver: a grid of springs and two blocks of tetrahedra, in
// double and float. On a GPU with nvcc; compiled by a C++ compiler it times the chosen backend of the host.
//   element_laws [--quick]     --quick: small bodies, a moment's run
#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/gpu/element_driver.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace sinew;

namespace {

struct Grid {
  int nx, ny, nz;
};

void synchronize() {
#if THRUST_DEVICE_SYSTEM == THRUST_DEVICE_SYSTEM_CUDA
  const cudaError_t status = cudaDeviceSynchronize();
  if (status != cudaSuccess) throw Error("element_laws", cudaGetErrorString(status));
#endif
}

double now() {  // [s]
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds a call takes when calls follow each other: the median of 7 batches of at least `batch` seconds.
template <class Call>
double seconds(Call const& call, double batch) {
  auto time = [&](int calls) {
    synchronize();
    const double start = now();
    for (int i = 0; i < calls; ++i) call();
    synchronize();
    return now() - start;
  };
  time(3);
  int calls = 1;
  double elapsed = time(calls);
  while (elapsed < batch) elapsed = time(calls *= 2);
  std::vector<double> times;
  for (int i = 0; i < 7; ++i) times.push_back(time(calls) / calls);
  std::nth_element(times.begin(), times.begin() + 3, times.end());
  return times[3];
}

template <template <class> class LawOf, class D>
struct Body {
  using Driver = gpu::ThrustElementDriver<LawOf, D>;
  std::vector<typename Driver::Indices> elements{};
  std::vector<typename Driver::Rest> rest{};
  std::vector<typename D::Coord> x{};
};

template <class D>
std::vector<typename D::Coord> points(Mesh const& mesh) {
  using Real = typename D::Real;
  std::vector<typename D::Coord> x;
  for (Eigen::Vector3d const& p : mesh.positions) x.push_back({Real(p[0]), Real(p[1]), Real(p[2])});
  return x;
}

/// Springs along the lines, both diagonals of each quad and the four diagonals of each cube; 4500 N/m.
template <class D>
Body<SpringLaw, D> springs(Grid grid) {
  using Real = typename D::Real;
  Body<SpringLaw, D> body;
  body.x = points<D>(regular_grid(grid.nx, grid.ny, grid.nz, {0, 0, 0}, {2.3, 1.2, 1.4}));
  // half of the 26 neighbours, each pair once
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        for (int neighbour = 14; neighbour < 27; ++neighbour) {
          const int a = i + neighbour % 3 - 1, b = j + neighbour / 3 % 3 - 1, c = k + neighbour / 9 - 1;
          if (a < 0 || b < 0 || a >= grid.nx || b >= grid.ny || c >= grid.nz) continue;
          const int first = i + grid.nx * (j + grid.ny * k), second = a + grid.nx * (b + grid.ny * c);
          const Real length = (body.x[std::size_t(second)] - body.x[std::size_t(first)]).norm();
          body.elements.push_back({first, second});
          body.rest.push_back({Real(4500), Real(1), length});
        }
  return body;
}

/// Corotational tetrahedra, six a cell.
template <class D>
Body<TetrahedronFEM, D> tetrahedra(Grid grid) {
  using Real = typename D::Real;
  Body<TetrahedronFEM, D> body;
  const Mesh mesh = regular_grid_tetrahedra(grid.nx, grid.ny, grid.nz, {0, 0, 0}, {1, 1, 1});
  body.x = points<D>(mesh);
  for (Tetrahedron const& t : mesh.tetrahedra) {
    typename D::Coord rest[4];
    for (std::size_t k = 0; k < 4; ++k) rest[k] = body.x[std::size_t(t[k])];
    body.elements.push_back(t);
    body.rest.push_back(TetrahedronFEM<D>::restOf(rest, Real(1000), Real(1500), RotationMethod::large));
  }
  return body;
}

/// Prints a row for each function. Bytes: every array of the two kernels counted once, as it is read or
/// written.
template <template <class> class LawOf, class D>
void measure(char const* name, Body<LawOf, D> body, double batch) {
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using Law = LawOf<D>;
  const std::size_t nodes = body.x.size(), elements = body.elements.size();
  gpu::ThrustElementDriver<LawOf, D> driver;
  driver.init(body.elements, body.rest, nodes);
  for (auto& p : body.x)
    p += Real(0.01) * typename D::Coord(std::sin(p[1]), std::cos(3 * p[2]), std::sin(2 * p[0]));
  const thrust::device_vector<typename D::Coord> x = body.x;
  const thrust::device_vector<Deriv> v = x;
  thrust::device_vector<Deriv> f(nodes, Deriv::Zero());

  // both functions: indices, rest data, forces written and read again, lists of the nodes, sum read and
  // written
  constexpr int ends = Law::arity;
  const double atElements = sizeof(typename Law::Rest) + ends * (2 * sizeof(int) + 2 * sizeof(Deriv)),
               tangent = sizeof(typename Law::Tangent), atNodes = sizeof(int) + 2 * sizeof(Deriv);
  const double both = double(elements) * (atElements + tangent) + double(nodes) * atNodes;
  const double force = both + double(nodes) * sizeof(Deriv) * (Law::usesVelocity ? 2 : 1),
               dforce = both + double(nodes) * sizeof(Deriv);
  auto row = [&](char const* function, double bytes, double time) {
    std::printf("%-22s %-6s %9zu %-10s %10.2f %12.1f %10.2f %9.1f\n",
                name,
                std::string(data_types_name<D>::value).c_str(),
                elements,
                function,
                1e6 * time,
                1e-6 * double(elements) / time,
                1e-6 * bytes,
                1e-9 * bytes / time);
  };
  row("addForce", force, seconds([&] { driver.addForce({}, f, x, v); }, batch));
  row("addDForce", dforce, seconds([&] { driver.addDForce({}, f, v, Real(0.7), Real(0.3)); }, batch));
}

template <class D>
void measureAll(bool quick) {
  const double batch = quick ? 1e-4 : 0.05;
  if (quick) {
    measure("springs 5x4x3", springs<D>({5, 4, 3}), batch);
    measure("tetrahedra 4x4x4", tetrahedra<D>({4, 4, 4}), batch);
    return;
  }
  measure("springs 24x13x15", springs<D>({24, 13, 15}), batch);
  measure("tetrahedra 18x18x18", tetrahedra<D>({18, 18, 18}), batch);
  measure("tetrahedra 56x56x56", tetrahedra<D>({56, 56, 56}), batch);
}

}  // namespace

int main(int count, char** words) {
  const bool quick = count == 2 && std::string_view(words[1]) == "--quick";
  if (count > 1 && !quick) {
    std::fputs("usage: element_laws [--quick]\n", stderr);
    return 2;
  }
#if THRUST_DEVICE_SYSTEM == THRUST_DEVICE_SYSTEM_CUDA
  cudaDeviceProp device;
  if (cudaGetDeviceProperties(&device, 0) != cudaSuccess) {
    std::puts("skipped: there is no GPU");
    return 77;
  }
  std::printf("%s\n", device.name);
#endif
  std::printf("%-22s %-6s %9s %-10s %10s %12s %10s %9s\n",
              "body",
              "type",
              "elements",
              "function",
              "us/call",
              "Melements/s",
              "MB",
              "GB/s");
  measureAll<Vec3d>(quick);
  measureAll<Vec3f>(quick);
  return 0;
}
