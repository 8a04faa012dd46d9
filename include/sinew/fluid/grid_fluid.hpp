// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/core/memory_limit.hpp>
#include <sinew/fluid/advection.hpp>
#include <sinew/fluid/cut_cells.hpp>
#include <sinew/fluid/grid_mesh.hpp>
#include <sinew/fluid/level_set.hpp>
#include <sinew/fluid/poisson_multigrid.hpp>
#include <sinew/fluid/pressure_regions.hpp>
#include <sinew/fluid/staggered_velocity.hpp>
#include <sinew/fluid/viscosity.hpp>

#include <string>

namespace sinew::fluid {

/// How fluid is moved along by solids that it touches: it sticks to them, or slips along them.
enum class Walls { slip, stick };
inline constexpr std::array<std::string_view, 2> enum_names(Walls) { return {"slip", "stick"}; }

/// What a fluid on a grid is, and how it is solved.
template <int N>
struct GridFluidSettings {
  using Vector = Eigen::Matrix<double, N, 1>;
  Each<int, N> cells{};  // inside the walls
  Each<bool, N> periodic{};
  double cellWidth = 1;            // h [m]
  Vector corner = Vector::Zero();  // lower, of the inside [m]
  double density = 1000;           // [kg/m^3]
  double viscosity = 0;            // dynamic [Pa s]
  Walls walls = Walls::slip;
  Advection advection = Advection::macCormack;
  bool hasSurface = true;  // else fluid is everywhere
  bool keepsVolume = true;
  double tolerance = 1e-6;  // of the pressure, relative
  int maxIterations = 100;
};

/// An incompressible fluid on a staggered grid of cells in 2 or 3 dimensions, with a free surface or without,
///   du/dt + (u.grad) u = g + nu Laplacian u - grad p / rho,   div u = 0,
/// by splitting: the surface and the velocity are carried along, gravity and viscosity act, and the pressure
/// takes away the divergence (Chorin 1968; Bridson 2015). At the free surface, wherever it crosses between
/// two cells, the pressure is zero (ghost fluid: Enright, Nguyen, Gibou, Fedkiw 2003), inside solids there is
/// none. Bodies that move through it cut its cells and are moved (CutCells). After init a step does not
/// allocate, and its bits do not depend on the number of threads.
template <class Real, int N>
class GridFluid {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Settings = GridFluidSettings<N>;
  static constexpr int dimension = N;

  StaggeredVelocity<Real, N> velocity{};
  LevelSet<Real, N> surface{};
  CutCells<Real, N> cut{};
  /// Solids that the next step meets; what it does to them stands there behind it.
  std::vector<ImmersedBody> bodies{};
  // what the last step did
  typename PoissonMultigrid<Real, N>::Result pressureSolve{};
  int viscosityIterations = 0;
  double courant = 0;  // cells that the fastest component goes in a step

  /// Throws Error where the settings are wrong.
  void init(std::string const& where, Settings const& settings) {
    where_ = where;
    settings_ = settings;
    double size = 1;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      if (settings.cells[c] < 1)
        throw Error(where,
                    text("there are ", settings.cells[c], " cells inside along an axis; take 1 or more"));
      if (settings.periodic[c] && settings.cells[c] % 2 == 1)
        throw Error(where,
                    text("there are ",
                         settings.cells[c],
                         " cells along a periodic axis; take an even number, best of all a power of two"));
      size *= double(settings.cells[c]) + 2;
    }
    check_memory(where, "the grid of the fluid", size * double(bytesOfCell) / double(bytesOfGridPoint));
    if (size > double(std::numeric_limits<int>::max()))
      throw Error(where,
                  text("the grid has ", size, " cells, more than an index can tell apart; make it coarser"));
    const CellGrid<N> grid(settings.cells, settings.periodic);
    velocity.init(grid);
    velocity.slips = settings.walls == Walls::slip;
    grid.forCells({}, [&](std::ptrdiff_t i) { velocity.cell[at(i)] = CellKind::fluid; });
    for (auto& field : next_) field.assign(grid.size, Real(0));
    pressure_.assign(grid.size, Real(0));
    sums_.assign(grid.rows(), 0.0);
    room_.init(grid.size);
    viscosity_.init(grid);
    multigrid_.init(grid);
    surface.init(grid, Real(bandCells));
    cut.init(grid);
    bodies.clear();
    obstacle_.assign(grid.size, 0);
    prepared_ = false;
    timeFactor_ = 0;
    volume_ = 0;
    measured_ = false;
  }
  Settings const& settings() const { return settings_; }
  CellGrid<N> const& grid() const { return velocity.grid; }

  /// Makes cells solid where inside(centre [m]) says so. It comes before setSurface().
  template <class F>
  void setSolids(F&& inside) {
    forCentres([&](std::ptrdiff_t i, Vector const& x) {
      if (!inside(x)) return;
      velocity.cell[at(i)] = CellKind::solid;
      obstacle_[at(i)] = 1;
    });
    prepared_ = false;
  }
  /// The fluid is where distance(centre [m]) is negative [m].
  template <class F>
  void setSurface(F&& distance) {
    forCentres([&](std::ptrdiff_t i, Vector const& x) {
      surface.value[at(i)] =
          Real(std::clamp(distance(x) / settings_.cellWidth, -double(bandCells), double(bandCells)));
    });
    surface.redistance(velocity, {});
  }
  /// Component c of the velocity is of(c, middle of the face [m]) [m/s].
  template <class F>
  void setVelocity(F&& of) {
    for (int c = 0; c < N; ++c)
      forCentres([&](std::ptrdiff_t i, Vector x) {
        x[c] -= settings_.cellWidth / 2;
        velocity.value[std::size_t(c)][at(i)] = Real(of(c, x));
      });
  }
  /// Takes what was set; comes behind it.
  void begin(SomeWorkers workers = {}) {
    classify(workers);
    velocity.holdWalls(workers);
    velocity.extrapolate(layers(), workers);
    volume_ = fluidCells(workers);
    measured_ = false;
    if (settings_.hasSurface && volume_ <= 0)
      throw Error(where_, "there is no fluid in the grid; raise its height, or take another direction");
  }

  /// Adds fluid where distance(centre [m]) is negative [m], with this velocity [m/s].
  template <class F>
  void pour(F&& distance, Vector const& speed, SomeWorkers workers) {
    const double before = fluidCells(workers);
    forCentres([&](std::ptrdiff_t i, Vector const& x) {
      if (velocity.cell[at(i)] == CellKind::solid) return;
      const Real d = Real(distance(x) / settings_.cellWidth);
      surface.value[at(i)] = std::min(surface.value[at(i)], std::max(d, Real(-bandCells)));
      if (d < Real(0.5))
        for (int c = 0; c < N; ++c)
          for (const std::ptrdiff_t j : {i, i + grid().stride[std::size_t(c)]})
            velocity.value[std::size_t(c)][at(j)] = Real(speed[c]);
    });
    surface.redistance(velocity, workers);
    volume_ += fluidCells(workers) - before;
    velocity.holdWalls(workers);
  }

  /// Takes the bodies that are met, and makes room for the faces that they have. Throws Error where one is
  /// outside.
  void reserveForBodies() {
    if (bodies.empty()) return;
    placeBodies({});
    measured_ = false;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      if (!cut.holds(int(b)))
        throw Error(
            where_,
            text("no corner of a cell is inside the solid ",
                 bodies[b].path,
                 ": it is outside of the grid, or smaller than a cell; move it into the grid, or take "
                 "smaller cells"));
    cut.faces.reserve(2 * cut.faces.size());
  }

  /// A step [s] under an acceleration [m/s^2]. Throws Error where the velocity is not finite.
  void step(double dt, Vector const& acceleration, SomeWorkers workers) {
    const Real perCell = Real(dt / settings_.cellWidth);
    const double fastest = velocity.fastest(workers, sums_);
    if (!std::isfinite(fastest))
      throw Error(where_,
                  "the velocity of the fluid is not finite: the simulation diverged; take a smaller dt");
    courant = fastest * double(perCell);
    placeBodies(workers);
    if (settings_.hasSurface) {
      surface.advect(velocity, perCell, settings_.advection, workers);
      surface.redistance(velocity, workers);
      if (settings_.keepsVolume) surface.keepVolume(velocity, room(), volume_, workers);
      classify(workers);
    }
    for (std::size_t c = 0; c < axes<N>; ++c)
      advect(
          velocity,
          int(c),
          velocity.value[c],
          next_[c],
          perCell,
          settings_.advection,
          room_,
          workers,
          [&](std::ptrdiff_t i) { return velocity.kind[c][at(i)] == FaceKind::fluid; },
          [&](std::vector<Real>& field) { velocity.fillAround(c, field); });
    for (std::size_t c = 0; c < axes<N>; ++c) velocity.value[c].swap(next_[c]);
    // Along a periodic axis an acceleration drives a flow, which viscosity holds back. Along the others
    // pressure answers it, and it comes behind viscosity: else what sticks to the walls of a pool at rest
    // would turn it over.
    accelerate(dt, acceleration, true, workers);
    velocity.holdWalls(workers);
    viscosityIterations = 0;
    if (settings_.viscosity > 0) {
      const double number =
          settings_.viscosity / settings_.density * dt / (settings_.cellWidth * settings_.cellWidth);
      viscosityIterations = viscosity_.apply(
          velocity, Real(number), settings_.tolerance * 1e-2, 10 * settings_.maxIterations, workers);
    }
    accelerate(dt, acceleration, false, workers);
    project(dt, workers);
    velocity.extrapolate(layers(), workers);
  }

  /// Of the fluid [m^3], in two dimensions [m^2].
  double volume(SomeWorkers workers = {}) { return fluidCells(workers) * cellVolume(); }
  /// [J], in two dimensions of a metre across the plane.
  double kineticEnergy(SomeWorkers workers = {}) {
    const double sum = grid().sum(workers, sums_, [&](std::ptrdiff_t i) {
      if (velocity.cell[at(i)] != CellKind::fluid) return 0.0;
      double squares = 0;
      for (std::size_t c = 0; c < axes<N>; ++c) {
        const double a = double(velocity.value[c][at(i)]),
                     b = double(velocity.value[c][at(i + grid().stride[c])]);
        squares += (a * a + b * b) / 2;
      }
      return part(i) * squares / 2;
    });
    return settings_.density * cellVolume() * sum;
  }
  /// - rho g.x summed up over the fluid [J].
  double gravityEnergy(Vector const& gravity, SomeWorkers workers = {}) {
    const double sum = grid().sum(workers, sums_, [&](std::ptrdiff_t i) {
      if (velocity.cell[at(i)] == CellKind::solid) return 0.0;
      return part(i) * gravity.dot(middle(i));
    });
    return -settings_.density * cellVolume() * sum;
  }
  /// The largest flow out of a fluid cell, over its volume [1/s].
  double divergence() const {
    double most = 0;
    for (std::size_t row = 0; row < grid().rows(); ++row) {
      const std::ptrdiff_t first = grid().index(grid().place(row));
      for (std::ptrdiff_t i = first; i < first + grid().cells[0]; ++i)
        if (velocity.cell[at(i)] == CellKind::fluid) most = std::max(most, std::abs(double(outflow(i))));
    }
    return most / settings_.cellWidth;
  }
  /// Of a fluid cell [Pa], after a step; 0 in others.
  double pressure(std::ptrdiff_t cell) const {
    return velocity.cell[at(cell)] == CellKind::fluid && timeFactor_ > 0
               ? double(pressure_[at(cell)]) * settings_.density * settings_.cellWidth / timeFactor_
               : 0;
  }
  /// At a place [m], multilinear [m/s].
  Vector velocityAt(Vector const& x) const {
    using V = Eigen::Matrix<Real, N, 1>;
    const V p = ((x - settings_.corner) / settings_.cellWidth).template cast<Real>();
    return velocity.velocity(velocity.inside(p)).template cast<double>();
  }
  /// Of the inner cell around a place.
  std::ptrdiff_t cellAt(Vector const& x) const {
    Each<int, N> place{};
    for (int c = 0; c < N; ++c) {
      const double k = std::floor((x[c] - settings_.corner[c]) / settings_.cellWidth) + 1;
      place[std::size_t(c)] = int(std::clamp(k, 1.0, double(grid().cells[std::size_t(c)])));
    }
    return grid().index(place);
  }
  Vector centre(std::ptrdiff_t i) const {
    Vector x;
    for (int c = N; c-- > 0;) {
      const std::ptrdiff_t s = grid().stride[std::size_t(c)];
      x[c] = settings_.corner[c] + (double(i / s) - 0.5) * settings_.cellWidth;
      i %= s;
    }
    return x;
  }
  double cellVolume() const { return std::pow(settings_.cellWidth, N); }

  /// All that the next step depends on: components of the velocity, distances, pressure, how many cells there
  /// are along each axis, the time step that the pressure was made with, and the volume that is kept. The
  /// list has room for it after the first call.
  void save(std::vector<Real>& to, SomeWorkers workers) const {
    const std::size_t n = grid().size;
    to.resize(n * (axes<N> + 2) + axes<N> + 2);
    auto lists = savedLists(*this);
    workers.run([&](WorkShare share) {
      for (std::size_t k = 0; k < lists.size(); ++k)
        std::copy(lists[k]->begin() + std::ptrdiff_t(share.begin(n)),
                  lists[k]->begin() + std::ptrdiff_t(share.end(n)),
                  to.begin() + std::ptrdiff_t(k * n + share.begin(n)));
    });
    Real* last = to.data() + lists.size() * n;
    for (const int count : settings_.cells) *last++ = Real(count);
    *last++ = Real(timeFactor_);
    *last = Real(measured_ ? volume_ : -volume_);
  }
  /// Whether a list is what this grid saves.
  bool saves(std::vector<Real> const& list) const {
    const std::size_t n = grid().size * (axes<N> + 2);
    if (list.size() != n + axes<N> + 2) return false;
    for (std::size_t c = 0; c < axes<N>; ++c)
      if (list[n + c] != Real(settings_.cells[c])) return false;
    return std::all_of(list.begin(), list.end(), [](Real value) { return std::isfinite(value); });
  }
  /// The inverse; comes in the place of what sets and begins.
  void restore(std::vector<Real> const& from, SomeWorkers workers = {}) {
    const std::size_t n = grid().size;
    auto lists = savedLists(*this);
    for (std::size_t k = 0; k < lists.size(); ++k)
      std::copy(from.begin() + std::ptrdiff_t(k * n),
                from.begin() + std::ptrdiff_t((k + 1) * n),
                lists[k]->begin());
    timeFactor_ = double(from[from.size() - 2]);
    const double last = double(from[from.size() - 1]);
    measured_ = last >= 0;
    volume_ = std::abs(last);
    classify(workers);
  }

  /// What is seen of it (fluid/grid_mesh.hpp).
  Mesh border() const { return border_of(*this); }
  Mesh cells() const { return cells_of(*this); }

  bool isSolid(std::ptrdiff_t i) const { return velocity.cell[at(i)] == CellKind::solid; }
  /// Where the border of the fluid is between the centres a and b, one of which is in the fluid [cells].
  double crossing(std::ptrdiff_t a, std::ptrdiff_t b) const {
    if (isSolid(a) || isSolid(b)) return 0.5;
    const double x = double(surface.value[at(a)]), y = double(surface.value[at(b)]);
    return std::clamp(x / (x - y), 0.0, 1.0);
  }

 private:
  static constexpr int bandCells = 6;
  static constexpr std::size_t bytesOfCell = 48 * sizeof(Real);

  std::string where_{};
  Settings settings_{};
  Each<std::vector<Real>, N> next_{};
  std::vector<Real> pressure_{};  // p dt / (rho h) [m/s]
  std::vector<double> sums_{};
  AdvectionRoom<Real> room_{};
  Viscosity<Real, N> viscosity_{};
  PoissonMultigrid<Real, N> multigrid_{};
  bool prepared_ = false;  // the equations of the pressure are those of a step before
  double timeFactor_ = 0;  // the step with which the pressure was made [s]
  double volume_ = 0;      // that is kept [cells]
  bool measured_ = false;  // with the bodies that take room; saved as its sign
  std::vector<std::uint8_t> obstacle_{};
  PressureRegions<Real, N> regions_{};

  static std::size_t at(std::ptrdiff_t i) { return std::size_t(i); }
  int layers() const { return std::min(bandCells + 2, int(std::ceil(std::min(courant, 16.0))) + 3); }
  double fluidCells(SomeWorkers workers) {
    if (settings_.hasSurface) return surface.volume(velocity, room(), workers);
    return grid().sum(workers, sums_, [&](std::ptrdiff_t i) {
      return velocity.cell[at(i)] == CellKind::fluid ? roomOf(i) : 0.0;
    });
  }
  std::span<Real const> room() const {
    return cut.any ? std::span<Real const>(cut.room) : std::span<Real const>();
  }
  double roomOf(std::ptrdiff_t i) const { return cut.any ? double(cut.room[at(i)]) : 1.0; }
  double part(std::ptrdiff_t i) const {
    return (settings_.hasSurface ? double(surface.fraction(i)) : 1.0) * roomOf(i);
  }
  // of the fluid in a cell, for one that is cut as by a plane across an axis [m]
  Vector middle(std::ptrdiff_t i) const {
    Vector x = centre(i);
    const double filled = settings_.hasSurface ? double(surface.fraction(i)) : 1.0;
    if (filled <= 0 || filled >= 1) return x;
    Vector slope;
    for (int c = 0; c < N; ++c) {
      const std::ptrdiff_t s = grid().stride[std::size_t(c)];
      slope[c] = double(surface.value[at(i + s)] - surface.value[at(i - s)]);
    }
    const double norm = slope.norm();
    if (norm > 0) x -= slope / norm * ((1 - filled) / 2 * settings_.cellWidth);
    return x;
  }
  template <class F>
  void forCentres(F&& f) const {
    grid().forCells({}, [&](std::ptrdiff_t i) { f(i, centre(i)); });
  }
  template <class Self>
  static auto savedLists(Self& self) {
    std::array<decltype(&self.pressure_), axes<N> + 2> lists{};
    for (std::size_t c = 0; c < axes<N>; ++c) lists[c] = &self.velocity.value[c];
    lists[axes<N>] = &self.surface.value;
    lists[axes<N> + 1] = &self.pressure_;
    return lists;
  }

  void classify(SomeWorkers workers) {
    if (settings_.hasSurface)
      grid().forCells(workers, [&](std::ptrdiff_t i) {
        CellKind& kind = velocity.cell[at(i)];
        if (kind != CellKind::solid)
          kind = surface.inFluid(surface.value[at(i)]) ? CellKind::fluid : CellKind::air;
      });
    velocity.classify(workers);
    cut.close(velocity);
  }
  void placeBodies(SomeWorkers workers) {
    if (bodies.empty() && !cut.any) return;
    if (!bodies.empty()) regions_.init(grid());
    cut.place(where_, bodies, settings_.corner, settings_.cellWidth, velocity, obstacle_);
    if (bodies.empty())  // they have gone
      grid().forCells(workers, [&](std::ptrdiff_t i) {
        if (!obstacle_[at(i)]) velocity.cell[at(i)] = CellKind::fluid;
      });
    classify(workers);
    cut.move(bodies, velocity);
    velocity.holdWalls(workers);
    prepared_ = false;
    if (!measured_) volume_ = fluidCells(workers);
    measured_ = true;
  }
  // how far from a fluid cell the surface is towards an air cell
  Real toSurface(std::ptrdiff_t fluidCell, std::ptrdiff_t airCell) const {
    const Real a = surface.value[at(fluidCell)], b = surface.value[at(airCell)];
    return std::clamp(a / (a - b), Real(0.01), Real(1));
  }
  Real outflow(std::ptrdiff_t i) const {
    Real sum = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) sum += flow(c, i + grid().stride[c]) - flow(c, i);
    return sum;
  }
  // through a face, of the fluid and of the solid in it
  Real flow(std::size_t c, std::ptrdiff_t i) const {
    const Real u = velocity.value[c][at(i)];
    return cut.any ? cut.open[c][at(i)] * u + (1 - cut.open[c][at(i)]) * velocity.solid[c][at(i)] : u;
  }
  Real openPart(std::size_t c, std::ptrdiff_t i) const { return cut.any ? cut.open[c][at(i)] : Real(1); }

  void accelerate(double dt, Vector const& acceleration, bool periodic, SomeWorkers workers) {
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const Real gain = Real(dt * acceleration[Eigen::Index(c)]);
      if (grid().periodic[c] != periodic || gain == 0) continue;
      grid().forCells(workers, [&](std::ptrdiff_t i) {
        if (velocity.kind[c][at(i)] == FaceKind::fluid) velocity.value[c][at(i)] += gain;
      });
    }
  }
  void prepare(SomeWorkers workers) {
    auto& top = multigrid_.finest();
    grid().forCells(workers, [&](std::ptrdiff_t i) {
      const auto k = at(i);
      const CellKind here = velocity.cell[k];
      top.open[k] = here != CellKind::solid;
      top.surface[k] = 0;
      for (std::size_t c = 0; c < axes<N>; ++c) {
        const std::ptrdiff_t s = grid().stride[c];
        const bool fluid = here == CellKind::fluid;
        top.face[c][k] = fluid && velocity.cell[at(i - s)] == CellKind::fluid ? openPart(c, i) : Real(0);
        if (fluid)
          for (const std::ptrdiff_t j : {i - s, i + s})
            if (velocity.cell[at(j)] == CellKind::air)
              top.surface[k] += openPart(c, std::max(i, j)) / toSurface(i, j);
      }
    });
    multigrid_.prepare(workers);
    prepared_ = true;
  }
  void project(double dt, SomeWorkers workers) {
    if (settings_.hasSurface || !prepared_) prepare(workers);
    auto& top = multigrid_.finest();
    for (std::size_t c = 0; c < axes<N>; ++c) grid().wrap(std::span<Real>(velocity.value[c]));
    bool closed = true;
    if (settings_.hasSurface)
      closed = grid().sum(workers, sums_, [&](std::ptrdiff_t i) { return double(top.surface[at(i)]); }) == 0;
    grid().forCells(workers, [&](std::ptrdiff_t i) {
      const bool fluid = velocity.cell[at(i)] == CellKind::fluid;
      top.b[at(i)] = fluid && top.inverse[at(i)] > 0 ? -outflow(i) : Real(0);
      // the pressure of the last step, as if it had been as long
      if (!fluid)
        pressure_[at(i)] = 0;
      else if (timeFactor_ > 0 && timeFactor_ != dt)
        pressure_[at(i)] *= Real(dt / timeFactor_);
    });
    if (cut.any) {
      regions_.balance(multigrid_.finest(), velocity);
    } else if (closed) {  // what no pressure can take away is of the rounding of walls that move
      const double sum = grid().sum(workers, sums_, [&](std::ptrdiff_t i) { return double(top.b[at(i)]); });
      const double count =
          grid().sum(workers, sums_, [&](std::ptrdiff_t i) { return top.inverse[at(i)] > 0 ? 1.0 : 0.0; });
      const Real mean = count > 0 ? Real(sum / count) : Real(0);
      grid().forCells(workers, [&](std::ptrdiff_t i) {
        if (top.inverse[at(i)] > 0) top.b[at(i)] -= mean;
      });
    }
    const double perPressure = settings_.density * cellVolume();
    pressureSolve = multigrid_.solve(pressure_,
                                     settings_.tolerance,
                                     settings_.maxIterations,
                                     workers,
                                     [&](std::vector<Real> const& q, std::vector<Real>& y) {
                                       if (cut.any) cut.respond(bodies, perPressure, q, y);
                                     });
    timeFactor_ = dt;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = grid().stride[c];
      grid().forCells(workers, [&](std::ptrdiff_t i) {
        if (velocity.kind[c][at(i)] != FaceKind::fluid) return;
        const bool below = velocity.cell[at(i - s)] == CellKind::fluid,
                   here = velocity.cell[at(i)] == CellKind::fluid;
        Real slope = 0;
        if (below && here)
          slope = pressure_[at(i)] - pressure_[at(i - s)];
        else if (here)
          slope = pressure_[at(i)] / toSurface(i, i - s);
        else
          slope = -pressure_[at(i - s)] / toSurface(i - s, i);
        velocity.value[c][at(i)] -= slope;
      });
      grid().wrap(std::span<Real>(velocity.value[c]));
    }
    if (cut.any) {
      cut.push(bodies, perPressure, dt, pressure_);
      cut.move(bodies, velocity);
      velocity.holdWalls(workers);
    }
  }
};

}  // namespace sinew::fluid
