// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/cut_cells.hpp>

#include <vector>

namespace sinew::fluid {

/// The drag of a viscous fluid on solids that cut its grid, to which it sticks, within the equations of
/// Viscosity. Faces with their middle inside a solid move with it; one beside such a face, along any axis, is
/// held by the surface that lies between them, at the part t of the way (Gibou, Fedkiw, Cheng, Kang 2002):
///   nu dt / h^2 (U - u) / t,   t = d_i / (d_i - d_j),   U = m . V,
/// with distances d of the middles from the surface. What the fluid loses there the solid gains,
///   impulse P = rho h^N nu dt / h^2 sum of m (u - U) / t,
/// and V = V* + R P makes the motion of rigid bodies a part of the equations, whose matrix stays symmetric.
template <class Real, int N, class Loops>
class WallDrag {
 public:
  using Cut = CutCells<Real, N, Loops>;
  using Velocity = StaggeredVelocity<Real, N, Loops>;
  using Fields = Each<typename Loops::template Array<Real>, N>;
  using Vector6 = ImmersedBody::Vector6;
  using Matrix6 = ImmersedBody::Matrix6;

  /// Room for as many faces as solids may have.
  void reserve(std::size_t faces, std::size_t bodies) {
    held_.reserve(faces);
    links_.reserve(2 * std::size_t(N) * faces);
    answers_.reserve(bodies);
  }

  /// Makes faces inside solids walls until finish(), and gives all their speeds. `number` is nu dt / h^2,
  /// `mass` rho h^N.
  void begin(Cut const& cut, std::vector<ImmersedBody>& bodies, Velocity& u, double number, double mass) {
    cut_ = &cut;
    number_ = number;
    perVelocity_ = number * mass;
    hold(u);
    findLinks(u);
    answers_.clear();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      Answer& answer = answers_.emplace_back();
      if (!bodies[b].answers()) continue;
      Matrix6 c = Matrix6::Zero();
      for (Link const& l : links_)
        if (Face const& f = face(l); f.body == int(b))
          c += perVelocity_ * double(l.strength) * f.mode * f.mode.transpose();
      // V = V* + R P,  P = sum of k m u - C V
      const Matrix6 system = Matrix6::Identity() + bodies[b].response * c;
      const Matrix6 inverse = inverse_of(system);
      answer.moves = true;
      answer.gain = inverse * bodies[b].response;
      bodies[b].motion = (inverse * bodies[b].motion).eval();
    }
    cut.move(bodies, u);
    for (std::size_t c = 0; c < axes<N>; ++c) u.grid.wrap(std::span<Real>(u.solid[c].data(), u.grid.size));
  }
  /// What the equations of the grid lack of it: they hold a face beside a wall by the factor that they know.
  void start(Velocity const& u, Fields& inverse, Fields& right) const {
    for (Link const& l : links_) {
      auto& one = inverse[l.axis][std::size_t(l.cell)];
      const Real more = Real(number_) * (l.strength - l.known);
      one = 1 / (1 / one + more);
      right[l.axis][std::size_t(l.cell)] += more * u.solid[l.axis][std::size_t(face(l).cell)];
    }
  }
  /// y += what the motion of bodies that answer takes from the drag, for velocities v.
  void respond(Fields const& v, Fields& y) const {
    for (std::size_t b = 0; b < answers_.size(); ++b) {
      if (!answers_[b].moves) continue;
      const Vector6 moved = answers_[b].gain * pull(int(b), v);
      for (Link const& l : links_)
        if (Face const& f = face(l); f.body == int(b))
          y[l.axis][std::size_t(l.cell)] -= Real(number_ * double(l.strength) * f.mode.dot(moved));
    }
  }
  /// Gives bodies their motions, and faces their drag, and lets faces go.
  void finish(Cut& cut, std::vector<ImmersedBody>& bodies, Velocity& u) const {
    for (std::size_t b = 0; b < answers_.size(); ++b)
      if (answers_[b].moves) bodies[b].motion += answers_[b].gain * pull(int(b), u.value);
    cut.move(bodies, u);
    for (Link const& l : links_) {
      Face& f = cut.faces[std::size_t(l.face)];
      const double apart =
          double(u.value[l.axis][std::size_t(l.cell)]) - double(u.solid[l.axis][std::size_t(f.cell)]);
      f.drag += perVelocity_ * double(l.strength) * apart;
    }
    for (const int k : held_) {
      Face const& f = cut.faces[std::size_t(k)];
      const auto c = std::size_t(f.axis), i = std::size_t(f.cell);
      u.kind[c][i] = FaceKind::fluid;
      u.value[c][i] = u.solid[c][i];
    }
    wrapKinds(u);
  }

 private:
  // by elimination with the largest pivots; nvcc takes Eigen's factors of such matrices for device code
  static Matrix6 inverse_of(Matrix6 a) {
    Matrix6 to = Matrix6::Identity();
    for (int c = 0; c < 6; ++c) {
      int pivot = c;
      for (int r = c + 1; r < 6; ++r)
        if (std::abs(a(r, c)) > std::abs(a(pivot, c))) pivot = r;
      if (pivot != c) {
        a.row(c).swap(a.row(pivot));
        to.row(c).swap(to.row(pivot));
      }
      to.row(c) /= a(c, c);
      a.row(c) /= a(c, c);
      for (int r = 0; r < 6; ++r) {
        if (r == c) continue;
        const double factor = a(r, c);
        to.row(r) -= factor * to.row(c);
        a.row(r) -= factor * a.row(c);
      }
    }
    return to;
  }

  using Face = typename Cut::Face;
  struct Link {
    std::size_t axis;
    int cell, face;  // what is held, and the face of the solid beside it
    Real strength, known;
  };
  struct Answer {
    bool moves = false;
    Matrix6 gain = Matrix6::Zero();  // (1 + R C)^-1 R
  };
  Cut const* cut_ = nullptr;
  double number_ = 0, perVelocity_ = 0;
  std::vector<int> held_{};
  std::vector<Link> links_{};
  std::vector<Answer> answers_{};

  Face const& face(Link const& l) const { return cut_->faces[std::size_t(l.face)]; }
  Vector6 pull(int body, Fields const& v) const {
    Vector6 sum = Vector6::Zero();
    for (Link const& l : links_)
      if (Face const& f = face(l); f.body == body)
        sum += perVelocity_ * double(l.strength) * double(v[l.axis][std::size_t(l.cell)]) * f.mode;
    return sum;
  }
  void wrapKinds(Velocity& u) const {
    for (std::size_t c = 0; c < axes<N>; ++c) u.grid.wrap(std::span<FaceKind>(u.kind[c].data(), u.grid.size));
  }
  void hold(Velocity& u) {
    held_.clear();
    for (std::size_t k = 0; k < cut_->faces.size(); ++k) {
      Face const& f = cut_->faces[k];
      auto& kind = u.kind[std::size_t(f.axis)][std::size_t(f.cell)];
      if (kind != FaceKind::fluid || cut_->distance(std::size_t(f.axis), f.cell) > 0) continue;
      kind = FaceKind::wall;
      held_.push_back(int(k));
    }
    wrapKinds(u);
  }
  void findLinks(Velocity const& u) {
    links_.clear();
    for (std::size_t k = 0; k < cut_->faces.size(); ++k) {
      Face const& f = cut_->faces[k];
      const auto c = std::size_t(f.axis);
      const double inside = cut_->distance(c, f.cell);
      if (inside > 0) continue;
      const auto i = std::size_t(f.cell);
      const bool between = u.kind[c][i] == FaceKind::inside;
      if (between &&
          (u.cell[i] != CellKind::solid || u.cell[i - std::size_t(u.grid.stride[c])] != CellKind::solid))
        continue;
      u.grid.forNeighbours(f.cell, [&](std::ptrdiff_t j) {
        if (u.kind[c][std::size_t(j)] != FaceKind::fluid) return;
        const double outside = std::max(cut_->distance(c, j), 0.0);
        const double way = std::clamp(outside / (outside - inside), 0.05, 1.0);
        links_.push_back({c, int(j), int(k), Real(1 / way), Real(between ? 2 : 1)});
      });
    }
  }
};

}  // namespace sinew::fluid
