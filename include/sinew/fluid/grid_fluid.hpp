// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/core/memory_limit.hpp>
#include <sinew/fluid/advection.hpp>
#include <sinew/fluid/cut_cells.hpp>
#include <sinew/fluid/fluid_view.hpp>
#include <sinew/fluid/grid_mesh.hpp>
#include <sinew/fluid/level_set.hpp>
#include <sinew/fluid/poisson_multigrid.hpp>
#include <sinew/fluid/pressure_regions.hpp>
#include <sinew/fluid/staggered_velocity.hpp>
#include <sinew/fluid/viscosity.hpp>
#include <sinew/fluid/wall_drag.hpp>

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
/// none. Bodies that move through it cut its cells and are moved (CutCells). `Loops` run it, on the host or
/// on a device. After init a step on the host does not allocate, and its bits do not depend on the number of
/// threads.
template <class Real, int N, class Loops = HostLoops>
class GridFluid {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Field = typename Loops::template Array<Real>;
  using Settings = GridFluidSettings<N>;
  static constexpr int dimension = N;

  StaggeredVelocity<Real, N, Loops> velocity{};
  LevelSet<Real, N, Loops> surface{};
  CutCells<Real, N, Loops> cut{};
  /// Solids that the next step meets; what it does to them stands there behind it.
  std::vector<ImmersedBody> bodies{};
  // what the last step did
  typename PoissonMultigrid<Real, N, Loops>::Result pressureSolve{};
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
    for (auto& field : next_) Loops::assign(field, grid.size, Real(0));
    Loops::assign(pressure_, grid.size, Real(0));
    numbers_.init(grid);
    room_.init(grid.size);
    if (settings.viscosity > 0) viscosity_.init(grid);
    multigrid_.init(grid);
    surface.init(grid, Real(bandCells));
    cut.init(grid);
    bodies.clear();
    Loops::assign(obstacle_, grid.size, std::uint8_t(0));
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
    surface.redistance(velocity, Loops());
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
    const Loops loops(workers);
    classify(loops);
    velocity.holdWalls(loops);
    velocity.extrapolate(layers(), loops);
    volume_ = rounded(fluidCells(loops));
    measured_ = false;
    if (settings_.hasSurface && volume_ <= 0)
      throw Error(where_, "there is no fluid in the grid; raise its height, or take another direction");
  }

  /// Adds fluid where distance(centre [m]) is negative [m], with this velocity [m/s]; `distance` is called
  /// where the loops run.
  template <class F>
  void pour(F const& distance, Vector const& speed, SomeWorkers workers) {
    const Loops loops(workers);
    const double before = fluidCells(loops);
    Pour<Real, N, F> body{view(), distance, speed, Real(bandCells), entries(surface.value), {}};
    for (std::size_t c = 0; c < axes<N>; ++c) body.value[c] = entries(velocity.value[c]);
    loops.cells(grid(), body);
    surface.redistance(velocity, loops);
    volume_ = rounded(volume_ + fluidCells(loops) - before);
    velocity.holdWalls(loops);
  }

  /// Takes the bodies that are met, and makes room for the faces that they have. Throws Error where one is
  /// outside.
  void reserveForBodies() {
    if (bodies.empty()) return;
    placeBodies(Loops());
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
    drag_.reserve(cut.faces.capacity(), bodies.size());
  }

  /// A step [s] under an acceleration [m/s^2]. Throws Error where the velocity is not finite.
  void step(double dt, Vector const& acceleration, SomeWorkers workers) {
    Loops::checkStep(where_);
    const Loops loops(workers);
    const Real perCell = Real(dt / settings_.cellWidth);
    const double fastest = velocity.fastest(loops, numbers_);
    if (!std::isfinite(fastest))
      throw Error(where_,
                  "the velocity of the fluid is not finite: the simulation diverged; take a smaller dt");
    courant = fastest * double(perCell);
    placeBodies(loops);
    if (settings_.hasSurface) {
      surface.advect(velocity, perCell, settings_.advection, loops);
      surface.redistance(velocity, loops);
      if (settings_.keepsVolume) surface.keepVolume(velocity, room(), volume_, loops);
      classify(loops);
    }
    for (std::size_t c = 0; c < axes<N>; ++c)
      advect(velocity,
             int(c),
             velocity.value[c],
             next_[c],
             perCell,
             settings_.advection,
             room_,
             loops,
             IsOfFluid{entries(std::as_const(velocity.kind[c]))},
             [&](Field& field) { velocity.fillAround(c, field, loops); });
    for (std::size_t c = 0; c < axes<N>; ++c) velocity.value[c].swap(next_[c]);
    // Along a periodic axis an acceleration drives a flow, which viscosity holds back. Along the others
    // pressure answers it, and it comes behind viscosity: else what sticks to the walls of a pool at rest
    // would turn it over.
    accelerate(dt, acceleration, true, loops);
    velocity.holdWalls(loops);
    viscosityIterations = 0;
    if (settings_.viscosity > 0) {
      const double number =
          settings_.viscosity / settings_.density * dt / (settings_.cellWidth * settings_.cellWidth);
      auto apply = [&](auto const&... more) {
        return viscosity_.apply(
            velocity, Real(number), settings_.tolerance * 1e-2, 10 * settings_.maxIterations, loops, more...);
      };
      if (cut.any && !velocity.slips) {
        drag_.begin(cut, bodies, velocity, number, settings_.density * cellVolume());
        viscosityIterations = apply(drag_);
        drag_.finish(cut, bodies, velocity);
      } else {
        viscosityIterations = apply();
      }
    }
    accelerate(dt, acceleration, false, loops);
    project(dt, loops);
    velocity.extrapolate(layers(), loops);
  }

  /// Of the fluid [m^3], in two dimensions [m^2].
  double volume(SomeWorkers workers = {}) { return fluidCells(Loops(workers)) * cellVolume(); }
  /// [J], in two dimensions of a metre across the plane.
  double kineticEnergy(SomeWorkers workers = {}) {
    return settings_.density * cellVolume() * sum(KineticPart<Real, N>{view()}, Loops(workers));
  }
  /// - rho g.x summed up over the fluid [J].
  double gravityEnergy(Vector const& gravity, SomeWorkers workers = {}) {
    return -settings_.density * cellVolume() * sum(HeightPart<Real, N>{view(), gravity}, Loops(workers));
  }
  /// The largest flow out of a fluid cell, over its volume [1/s].
  double divergence() {
    return Loops().most(grid(), numbers_, Outflow<Real, N>{view()}) / settings_.cellWidth;
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
    VelocityView<Real, N> here{grid(), velocity.slips, nullptr, {}, {}, {}};
    for (std::size_t c = 0; c < axes<N>; ++c) here.value[c] = velocity.value[c].data();
    return here.velocity(here.inside(p)).template cast<double>();
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
  void save(Field& to, SomeWorkers workers) const {
    const std::size_t n = grid().size;
    std::array<Real, axes<N> + 2> last;
    for (std::size_t c = 0; c < axes<N>; ++c) last[c] = Real(settings_.cells[c]);
    last[axes<N>] = Real(timeFactor_);
    last[axes<N> + 1] = Real(measured_ ? volume_ : -volume_);
    Loops(workers).join(savedLists(*this), n, last, to);
  }
  /// Whether a list is what this grid saves.
  bool saves(Field const& list) const {
    const std::size_t n = grid().size * (axes<N> + 2);
    if (list.size() != n + axes<N> + 2) return false;
    for (std::size_t c = 0; c < axes<N>; ++c)
      if (list[n + c] != Real(settings_.cells[c])) return false;
    return std::all_of(list.begin(), list.end(), [](Real value) { return std::isfinite(value); });
  }
  /// The inverse; comes in the place of what sets and begins.
  void restore(Field const& from, SomeWorkers workers = {}) {
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
    classify(Loops(workers));
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
  static constexpr std::size_t bytesOfCell = 58 * sizeof(Real);

  std::string where_{};
  Settings settings_{};
  Each<Field, N> next_{};
  Field pressure_{};  // p dt / (rho h) [m/s]
  typename Loops::Numbers numbers_{};
  AdvectionRoom<Real, Loops> room_{};
  Viscosity<Real, N, Loops> viscosity_{};
  WallDrag<Real, N, Loops> drag_{};
  PoissonMultigrid<Real, N, Loops> multigrid_{};
  bool prepared_ = false;  // the equations of the pressure are those of a step before
  double timeFactor_ = 0;  // the step with which the pressure was made [s]
  double volume_ = 0;      // that is kept [cells]
  bool measured_ = false;  // with the bodies that take room; saved as its sign
  typename Loops::template Array<std::uint8_t> obstacle_{};
  PressureRegions<Real, N, Loops> regions_{};

  static std::size_t at(std::ptrdiff_t i) { return std::size_t(i); }
  // what save() keeps of a number
  static double rounded(double value) { return double(Real(value)); }
  int layers() const { return std::min(bandCells + 2, int(std::ceil(std::min(courant, 16.0))) + 3); }
  FluidView<Real, N> view() const {
    FluidView<Real, N> v{velocity.view(),
                         settings_.hasSurface ? entries(surface.value) : nullptr,
                         {},
                         room(),
                         settings_.corner,
                         settings_.cellWidth};
    if (cut.any)
      for (std::size_t c = 0; c < axes<N>; ++c) v.open[c] = entries(cut.open[c]);
    return v;
  }
  Real const* room() const { return cut.any ? entries(cut.room) : nullptr; }
  template <class Term>
  double sum(Term const& term, Loops const& loops) {
    loops.sum(grid(), numbers_, 0, term);
    return numbers_.read(0);
  }
  double fluidCells(Loops const& loops) {
    if (settings_.hasSurface) return surface.volume(velocity, room(), loops);
    return sum(RoomOfFluid<Real, N>{view()}, loops);
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

  void classify(Loops const& loops) {
    if (settings_.hasSurface)
      loops.cells(grid(),
                  ClassifyCells<Real, N>{entries(std::as_const(surface.value)), entries(velocity.cell)});
    velocity.classify(loops);
    cut.close(velocity);
  }
  void placeBodies(Loops const& loops) {
    if (bodies.empty() && !cut.any) return;
    if (!bodies.empty()) regions_.init(grid());
    cut.place(where_, bodies, settings_.corner, settings_.cellWidth, velocity, obstacle_);
    if (bodies.empty())  // they have gone
      loops.cells(grid(), FreeCells<N>{entries(std::as_const(obstacle_)), entries(velocity.cell)});
    classify(loops);
    cut.move(bodies, velocity);
    velocity.holdWalls(loops);
    prepared_ = false;
    if (!measured_) volume_ = rounded(fluidCells(loops));
    measured_ = true;
  }
  void accelerate(double dt, Vector const& acceleration, bool periodic, Loops const& loops) {
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const Real gain = Real(dt * acceleration[Eigen::Index(c)]);
      if (grid().periodic[c] != periodic || gain == 0) continue;
      loops.cells(
          grid(),
          Accelerate<Real, N>{entries(std::as_const(velocity.kind[c])), entries(velocity.value[c]), gain});
    }
  }
  void project(double dt, Loops const& loops) {
    auto& top = multigrid_.finest();
    if (settings_.hasSurface || !prepared_) {
      loops.cells(grid(), PressureEquation<Real, N>{view(), top.view()});
      multigrid_.prepare(loops);
      prepared_ = true;
    }
    for (std::size_t c = 0; c < axes<N>; ++c) loops.wrap(grid(), entries(velocity.value[c]));
    Real const* const inverse = entries(std::as_const(top.inverse));
    const bool closed =
        !settings_.hasSurface || sum(ValueOf<Real>{entries(std::as_const(top.surface))}, loops) == 0;
    const bool scales = timeFactor_ > 0 && timeFactor_ != rounded(dt);
    loops.cells(grid(),
                PressureStart<Real, N>{view(),
                                       inverse,
                                       entries(top.b),
                                       entries(pressure_),
                                       scales,
                                       scales ? Real(rounded(dt) / timeFactor_) : Real(1)});
    if (cut.any) {
      regions_.balance(top);
    } else if (closed) {  // what no pressure can take away is of the rounding of walls that move
      loops.sum(grid(), numbers_, 0, ValueOf<Real>{entries(std::as_const(top.b))});
      loops.sum(grid(), numbers_, 1, IsPositive<Real>{inverse});
      loops.cells(grid(), TakeMean<Real, N>{inverse, entries(top.b), numbers_.at(0), numbers_.at(1)});
    }
    const double perPressure = settings_.density * cellVolume();
    pressureSolve = multigrid_.solve(pressure_,
                                     settings_.tolerance,
                                     settings_.maxIterations,
                                     loops,
                                     Answer{cut, bodies, perPressure, cut.any});
    timeFactor_ = rounded(dt);
    for (std::size_t c = 0; c < axes<N>; ++c) {
      loops.cells(
          grid(),
          TakeGradient<Real, N>{view(), c, entries(std::as_const(pressure_)), entries(velocity.value[c])});
      loops.wrap(grid(), entries(velocity.value[c]));
    }
    if (cut.any) {
      cut.push(bodies, perPressure, dt, pressure_);
      cut.move(bodies, velocity);
      velocity.holdWalls(loops);
    }
  }
  /// What bodies that answer add to the matrix of the pressure.
  struct Answer {
    CutCells<Real, N, Loops>& cut;
    std::vector<ImmersedBody> const& bodies;
    double perPressure;
    bool any;
    void operator()(Field const& q, Field& y) const { cut.respond(bodies, perPressure, q, y); }
  };
};

}  // namespace sinew::fluid
