// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/staggered_velocity.hpp>
#include <sinew/fluid/surface_distance.hpp>

#include <Eigen/Cholesky>

#include <vector>

namespace sinew::fluid {

/// The part of a unit square, or for two values of a unit edge, in which what is linear along its edges is
/// positive; values of the corners go around.
template <std::size_t Corners>
double positive_part(std::array<double, Corners> const& value) {
  auto crossing = [](double a, double b) { return a / (a - b); };
  if constexpr (Corners == 2) {
    auto const [a, b] = value;
    if ((a > 0) == (b > 0)) return a > 0 ? 1 : 0;
    return a > 0 ? crossing(a, b) : 1 - crossing(a, b);
  } else {
    constexpr std::array<std::array<double, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    // the area of the polygon of positive corners and crossings
    std::array<double, 2> first{}, last{};
    double twice = 0;
    bool some = false;
    auto go = [&](std::array<double, 2> const& to) {
      if (some)
        twice += last[0] * to[1] - to[0] * last[1];
      else
        first = to;
      some = true;
      last = to;
    };
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      if (value[k] > 0) go(corners[k]);
      if ((value[k] > 0) == (value[next] > 0)) continue;
      const double t = crossing(value[k], value[next]);
      go({corners[k][0] + t * (corners[next][0] - corners[k][0]),
          corners[k][1] + t * (corners[next][1] - corners[k][1])});
    }
    if (some) go(first);
    return std::clamp(twice / 2, 0.0, 1.0);
  }
}

/// to[k] = from[place[k]], 0 where there is none
template <class Real>
struct TakeAt {
  Real const* from;
  int const* place;
  Real* to;
  SINEW_HD void operator()(int k) const { to[k] = place[k] < 0 ? Real(0) : from[place[k]]; }
};
/// to[place[k]] += value[k]
template <class Real>
struct AddAt {
  Real* to;
  int const* place;
  Real const* value;
  SINEW_HD void operator()(int k) const {
    if (place[k] >= 0) to[place[k]] += value[k];
  }
};

/// Solids that move through a grid and cut its cells (Batty, Bertails, Bridson 2007). Of the box of a cell
/// around each face the part a is open, and in the rest goes the solid, so that the flow out of a cell is
///   sum over faces of +-(a u + (1 - a) U),  U = m . V,  m = (e, r x e)
/// for a rigid body with the motion V = (v, w), across the axis e. Pressure does work on it where it takes
/// room from the cells:
///   impulse P = rho h^N sum over faces of (1 - a) m (q below - q above),  q = p dt / (rho h),
/// and V = V* + R P makes its motion a part of the equations of q, whose matrix stays symmetric.
template <class Real, int N, class Loops = HostLoops>
class CutCells {
 public:
  using Velocity = StaggeredVelocity<Real, N, Loops>;
  using Field = typename Loops::template Array<Real>;
  using Vector = Eigen::Matrix<double, N, 1>;
  /// A face with a solid in it.
  struct Face {
    int axis, cell, body;  // the lower face of the cell
    Real part;             // 1 - a
    bool below, above;     // there is fluid in the cells on these sides
    std::array<Index, 3> points;
    Eigen::Vector3d weights;  // of the points nearest to it on the surface
    ImmersedBody::Vector6 mode;
    double drag = 0;  // impulse on the body by viscosity, along the axis [N s]
  };

  Each<Field, N> open{};  // a
  Field room{};           // of each cell, outside solids
  std::vector<Face> faces{};
  bool any = false;

  void init(CellGrid<N> const& grid) {
    grid_ = grid;
    ready_ = false;
    any = false;
    faces.clear();
  }

  /// Takes bodies where they are. Cells that they fill are solid, others are what they are without them:
  /// `kind` of obstacles stays.
  void place(std::string const& where, std::vector<ImmersedBody> const& bodies, Vector const& corner,
             double h, Velocity& u, typename Loops::template Array<std::uint8_t> const& obstacle) {
    for (Face const& f : faces) u.solid[std::size_t(f.axis)][std::size_t(f.cell)] = 0;
    faces.clear();
    any = !bodies.empty();
    if (!any) return;
    if (!ready_) reserve();
    auto place = [&](Eigen::Vector3d const& x) {
      Eigen::Vector3d p(0, 0, 0);
      p.template head<N>() = (x.template head<N>() - corner) / h;
      return p;
    };
    distance_.clear();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      check(where, bodies[b]);
      distance_.add(bodies[b], int(b), place);
    }
    measure();
    bool some = false;
    grid_.forCells({}, [&](std::ptrdiff_t i) {
      if (obstacle[at(i)]) return;
      bool closed = true;
      for (std::size_t c = 0; c < axes<N>; ++c)
        closed = closed && open[c][at(i)] == 0 && open[c][at(i + grid_.stride[c])] == 0;
      room[at(i)] = closed ? Real(0) : Real(roomOf(i));
      u.cell[at(i)] = closed ? CellKind::solid : CellKind::fluid;  // of which kind is seen later
      some = some || !closed;
    });
    findFaces(bodies, corner, h, place, obstacle);
    for (std::size_t c = 0; c < axes<N>; ++c) grid_.wrap(std::span<Real>(open[c].data(), grid_.size));
    if (!some)
      throw Error(where,
                  text("solids fill all of the grid, ",
                       bodies[0].path,
                       " among them, and leave no room for the fluid; make the grid larger than they are"));
  }

  /// Whether a corner of a cell is inside a body.
  bool holds(int body) const {
    for (std::size_t i = 0; i < distance_.body.size(); ++i)
      if (distance_.body[i] == body && distance_.value[i] < 0) return true;
    return false;
  }

  /// Faces that solids close are walls; comes behind the kinds of cells and faces.
  void close(Velocity& u) {
    for (Face& f : faces) {
      const auto c = std::size_t(f.axis);
      const std::ptrdiff_t i = f.cell, below = i - grid_.stride[c];
      f.below = u.cell[at(below)] == CellKind::fluid;
      f.above = u.cell[at(i)] == CellKind::fluid;
      if (open[c][at(i)] == 0 && (u.cell[at(i)] != CellKind::solid || u.cell[at(below)] != CellKind::solid))
        u.kind[c][at(i)] = FaceKind::wall;
    }
    if constexpr (!Loops::onHost) findEnds();
  }
  /// Of the middle of a face from solids, negative inside [cells].
  double distance(std::size_t c, std::ptrdiff_t i) const {
    double sum = 0;
    constexpr std::size_t corners = std::size_t(1) << (N - 1);
    for (std::size_t k = 0; k < corners; ++k) {
      std::ptrdiff_t j = i;
      for (std::size_t d = 1; d < axes<N>; ++d)
        if (k >> (d - 1) & 1) j += grid_.stride[(c + d) % axes<N>];
      sum += distance_.value[at(j)];
    }
    return sum / double(corners);
  }
  /// Velocities of the solids at their faces, rigid bodies with these motions.
  void move(std::vector<ImmersedBody> const& bodies, Velocity& u) const {
    for (Face const& f : faces) {
      ImmersedBody const& body = bodies[std::size_t(f.body)];
      double speed = 0;
      if (body.rigid)
        speed = f.mode.dot(body.motion);
      else
        for (std::size_t k = 0; k < axes<N>; ++k)
          speed += f.weights[Eigen::Index(k)] * body.velocities[std::size_t(f.points[k])][f.axis];
      u.solid[std::size_t(f.axis)][std::size_t(f.cell)] = Real(speed);
    }
  }

  /// y += what pressure q lets flow out of cells by moving the bodies that answer; impulses are rho h^N times
  /// sums of q.
  void respond(std::vector<ImmersedBody> const& bodies, double perPressure, Field const& q, Field& y) {
    if constexpr (Loops::onHost)
      respondHere(bodies, perPressure, q, y);
    else
      respondThere(bodies, perPressure, q, y);
  }
  /// Gives bodies their forces over a step, and those that answer their motions.
  void push(std::vector<ImmersedBody>& bodies, double perPressure, double dt, Field const& q) const {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      ImmersedBody& body = bodies[b];
      body.forces.assign(body.positions.size(), Eigen::Vector3d::Zero());
      body.load = perPressure / dt * sum(int(b), q);
      if (body.answers()) body.motion += body.response * body.load * dt;  // drag has moved it
      for (Face const& f : faces) {
        if (f.body != int(b)) continue;
        const double force = (perPressure * double(f.part) * drop(f, q) + f.drag) / dt;
        for (std::size_t k = 0; k < axes<N>; ++k)
          body.forces[std::size_t(f.points[k])][f.axis] += f.weights[Eigen::Index(k)] * force;
        body.load += f.drag / dt * f.mode;
      }
      keepMoment(body);
    }
  }

 private:
  CellGrid<N> grid_{};
  SurfaceDistance<N> distance_{};
  bool ready_ = false;

  static std::size_t at(std::ptrdiff_t i) { return std::size_t(i); }
  void reserve() {
    distance_.init(grid_);
    for (auto& part : open) part.assign(grid_.size, Real(1));
    room.assign(grid_.size, Real(1));
    ready_ = true;
  }
  static void check(std::string const& where, ImmersedBody const& body) {
    for (std::size_t k = 0; k < body.positions.size(); ++k)
      if (!body.positions[k].allFinite() || !body.velocities[k].allFinite())
        throw Error(where,
                    text("point ",
                         k,
                         " of the solid ",
                         body.path,
                         " is not finite, or its velocity; the body diverged: take a smaller dt"));
  }

  // a of all faces; below 1e-3 they are closed
  void measure() {
    auto part = [&](std::size_t c, std::ptrdiff_t i) {
      const double a = openAround(c, i);
      open[c][at(i)] = a < 1e-3 ? Real(0) : Real(a);
    };
    for (std::size_t c = 0; c < axes<N>; ++c) {
      grid_.forCells({}, [&](std::ptrdiff_t i) { part(c, i); });
      grid_.forSides(c, false, [&](std::ptrdiff_t outer, std::ptrdiff_t, std::ptrdiff_t, int side) {
        if (side == 1) part(c, outer);
      });
    }
  }

  // a of a face: that of both halves of the box around it; in space the mean of two sections of each, across
  // that axis of the face along which distances change less
  double openAround(std::size_t c, std::ptrdiff_t i) const {
    // the corners of the face, and those of the cells on both sides; behind the last cell there is none
    const std::ptrdiff_t s = grid_.stride[c];
    const std::ptrdiff_t place = i / s % (grid_.cells[c] + 2);
    double line[std::size_t(1) << (N - 1)][3];  // along c
    bool outside = false, inside = false;
    for (std::size_t k = 0; k < std::size_t(1) << (N - 1); ++k) {
      std::ptrdiff_t j = i;
      for (std::size_t d = 1; d < axes<N>; ++d)
        if (k >> (d - 1) & 1) j += grid_.stride[(c + d) % axes<N>];
      const double here = distance_.value[at(j)];
      const double below = place > 1 ? distance_.value[at(j - s)] : here;
      const double above = place <= grid_.cells[c] ? distance_.value[at(j + s)] : here;
      line[k][0] = (below + here) / 2, line[k][1] = here, line[k][2] = (here + above) / 2;
      for (const double value : line[k]) (value > 0 ? outside : inside) = true;
    }
    if (!outside || !inside) return outside ? 1 : 0;
    double sum = 0;
    if constexpr (N == 2) {
      for (const std::size_t half : {std::size_t(0), std::size_t(1)})
        sum += positive_part<4>({line[0][half], line[0][half + 1], line[1][half + 1], line[1][half]}) / 2;
    } else {
      const double first = line[1][1] - line[0][1] + line[3][1] - line[2][1],
                   second = line[2][1] - line[0][1] + line[3][1] - line[1][1];
      const std::size_t across = std::abs(first) < std::abs(second) ? 1 : 2, beside = 3 - across;
      for (const std::size_t half : {std::size_t(0), std::size_t(1)})
        for (const double z : {0.25, 0.75}) {
          auto value = [&](std::size_t low, std::size_t h) {
            return line[low][h] + z * (line[low + across][h] - line[low][h]);
          };
          sum += positive_part<4>(
                     {value(0, half), value(0, half + 1), value(beside, half + 1), value(beside, half)}) /
                 4;
        }
    }
    return sum;
  }
  // The part of a cell outside solids: in space the mean of four sections, across the axis along which
  // distances change least.
  double roomOf(std::ptrdiff_t i) const {
    // plain, since nvcc's front end takes std::array<double, 1 << N> for others of its kind
    double value[std::size_t(1) << N];
    bool outside = false, inside = false;
    for (std::size_t k = 0; k < std::size_t(1) << N; ++k) {
      std::ptrdiff_t j = i;
      for (std::size_t c = 0; c < axes<N>; ++c)
        if (k >> c & 1) j += grid_.stride[c];
      value[k] = distance_.value[at(j)];
      (value[k] > 0 ? outside : inside) = true;
    }
    if (!outside || !inside) return outside ? 1 : 0;
    if constexpr (N == 2) {
      return positive_part<4>({value[0], value[1], value[3], value[2]});
    } else {
      std::size_t across = 0;
      double least = std::numeric_limits<double>::max();
      for (std::size_t c = 0; c < 3; ++c) {
        double change = 0;
        for (std::size_t k = 0; k < 8; ++k) change += k >> c & 1 ? value[k] : -value[k];
        if (std::abs(change) < least) least = std::abs(change), across = c;
      }
      const std::size_t up = std::size_t(1) << across, s = std::size_t(1) << (across + 1) % 3,
                        t = std::size_t(1) << (across + 2) % 3;
      double sum = 0;
      for (const double z : {0.125, 0.375, 0.625, 0.875}) {
        auto section = [&](std::size_t k) { return value[k] + z * (value[k + up] - value[k]); };
        sum += positive_part<4>({section(0), section(s), section(s + t), section(t)}) / 4;
      }
      return sum;
    }
  }

  template <class Place>
  void findFaces(std::vector<ImmersedBody> const& bodies, Vector const& corner, double h, Place&& place,
                 typename Loops::template Array<std::uint8_t> const& obstacle) {
    for (std::size_t c = 0; c < axes<N>; ++c) {
      // what is beside a wall is the wall's
      grid_.forSides(c, false, [&](std::ptrdiff_t outer, std::ptrdiff_t, std::ptrdiff_t, int side) {
        if (side == 1 && !grid_.periodic[c]) open[c][at(outer)] = 1;
      });
      const std::ptrdiff_t s = grid_.stride[c];
      grid_.forRows(WorkShare{}, [&](std::size_t row, std::ptrdiff_t first) {
        auto p = grid_.place(row);
        for (std::ptrdiff_t i = first; p[0] <= grid_.cells[0]; ++i, ++p[0]) {
          if (obstacle[at(i)] || obstacle[at(i - s)] || (p[c] == 1 && !grid_.periodic[c])) {
            open[c][at(i)] = 1;
            continue;
          }
          if (open[c][at(i)] >= 1) continue;
          const std::ptrdiff_t nearest = nearestCorner(c, i);
          const int b = distance_.body[at(nearest)], e = distance_.element[at(nearest)];
          if (b < 0 || e < 0) continue;  // far inside
          ImmersedBody const& body = bodies[std::size_t(b)];
          Eigen::Vector3d middle(0, 0, 0);
          for (std::size_t d = 0; d < axes<N>; ++d) middle[Eigen::Index(d)] = p[d] - (d == c ? 1 : 0.5);
          Face f{
              int(c), int(i), b, 1 - open[c][at(i)], false, false, body.elements[std::size_t(e)], {}, {}, 0};
          f.weights = distance_.weights(body, e, middle, place);
          Eigen::Vector3d arm = -body.centre;
          arm.template head<N>() += corner + h * middle.template head<N>();
          if constexpr (N == 2) arm[2] = 0;
          f.mode << Eigen::Vector3d::Unit(f.axis), arm.cross(Eigen::Vector3d::Unit(f.axis));
          faces.push_back(f);
        }
      });
    }
  }
  // of the corners of a face that with an element near whose distance is least
  std::ptrdiff_t nearestCorner(std::size_t c, std::ptrdiff_t i) const {
    std::ptrdiff_t best = i;
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < std::size_t(1) << N; ++k) {
      if (k >> c & 1) continue;
      std::ptrdiff_t j = i;
      for (std::size_t d = 0; d < axes<N>; ++d)
        if (k >> d & 1) j += grid_.stride[d];
      const double d = std::abs(distance_.value[at(j)]);
      if (distance_.element[at(j)] < 0 || !(d < least)) continue;
      least = d;
      best = j;
    }
    return best;
  }

  void respondHere(std::vector<ImmersedBody> const& bodies, double perPressure, Field const& q,
                   Field& y) const {
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!bodies[b].answers()) continue;
      const ImmersedBody::Vector6 gain = bodies[b].response * (perPressure * sum(int(b), q));
      for (Face const& f : faces) {
        if (f.body != int(b)) continue;
        const Real flux = f.part * Real(f.mode.dot(gain));
        if (f.below) y[at(f.cell - grid_.stride[std::size_t(f.axis)])] += flux;
        if (f.above) y[at(f.cell)] -= flux;
      }
    }
  }
  // The same where the fluid is on a device: pressures beside faces come, flows go. Faces are in the order of
  // their axes; of each axis those below are first, then those above, so that no two of a part are of one
  // cell.
  typename Loops::template Array<int> ends_{};
  Field beside_{};
  std::array<std::size_t, axes<N> + 1> begins_{};  // of the faces of each axis

  template <class F>
  void forEnds(F&& f) const {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const std::size_t first = begins_[std::size_t(faces[k].axis)],
                        n = begins_[std::size_t(faces[k].axis) + 1] - first;
      f(faces[k], first + k, first + n + k);
    }
  }
  void findEnds() {
    begins_.fill(0);
    for (Face const& f : faces) ++begins_[std::size_t(f.axis) + 1];
    for (std::size_t c = 0; c < axes<N>; ++c) begins_[c + 1] += begins_[c];
    ends_.assign(2 * faces.size(), -1);
    beside_.assign(2 * faces.size(), Real(0));
    int* const ends = ends_.data();
    forEnds([&](Face const& f, std::size_t below, std::size_t above) {
      if (f.below) ends[below] = f.cell - int(grid_.stride[std::size_t(f.axis)]);
      if (f.above) ends[above] = f.cell;
    });
  }
  void respondThere(std::vector<ImmersedBody> const& bodies, double perPressure, Field const& q, Field& y) {
    if (std::none_of(bodies.begin(), bodies.end(), [](auto const& body) { return body.answers(); })) return;
    Loops::each(ends_.size(), TakeAt<Real>{entries(q), entries(std::as_const(ends_)), overwritten(beside_)});
    Real* const value = beside_.data();
    sums_.assign(bodies.size(), ImmersedBody::Vector6::Zero());
    forEnds([&](Face const& f, std::size_t below, std::size_t above) {
      sums_[std::size_t(f.body)] += double(f.part) * (double(value[below]) - double(value[above])) * f.mode;
    });
    for (std::size_t b = 0; b < bodies.size(); ++b)
      sums_[b] = bodies[b].answers() ? (bodies[b].response * (perPressure * sums_[b])).eval()
                                     : ImmersedBody::Vector6::Zero().eval();
    forEnds([&](Face const& f, std::size_t below, std::size_t above) {
      const Real flux = f.part * Real(f.mode.dot(sums_[std::size_t(f.body)]));
      value[below] = flux;
      value[above] = -flux;
    });
    Real const* const flows = entries(std::as_const(beside_));
    int const* const ends = entries(std::as_const(ends_));
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::size_t n = begins_[c + 1] - begins_[c];
      for (const std::size_t from : {2 * begins_[c], 2 * begins_[c] + n})
        Loops::each(n, AddAt<Real>{entries(y), ends + from, flows + from});
    }
  }
  std::vector<ImmersedBody::Vector6> sums_{};

  double drop(Face const& f, Field const& q) const {
    return (f.below ? double(q[at(f.cell - grid_.stride[std::size_t(f.axis)])]) : 0.0) -
           (f.above ? double(q[at(f.cell)]) : 0.0);
  }
  ImmersedBody::Vector6 sum(int body, Field const& q) const {
    ImmersedBody::Vector6 all = ImmersedBody::Vector6::Zero();
    for (Face const& f : faces)
      if (f.body == body) all += double(f.part) * drop(f, q) * f.mode;
    return all;
  }
  // Faces are not quite where the points are on which their forces act: the least forces that give the moment
  // about the centre back.
  static void keepMoment(ImmersedBody& body) {
    Eigen::Vector3d mean(0, 0, 0), missing = body.load.tail<3>();
    for (auto const& x : body.positions) mean += x / double(body.positions.size());
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < body.positions.size(); ++k) {
      missing -= (body.positions[k] - body.centre).cross(body.forces[k]);
      const Eigen::Vector3d r = body.positions[k] - mean;
      inertia += r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose();
    }
    const Eigen::LDLT<Eigen::Matrix3d> factor(inertia);
    if (!(factor.vectorD().minCoeff() > 0)) return;
    const Eigen::Vector3d turn = factor.solve(missing);
    for (std::size_t k = 0; k < body.positions.size(); ++k)
      body.forces[k] += turn.cross(Eigen::Vector3d(body.positions[k] - mean));
  }
};

}  // namespace sinew::fluid
