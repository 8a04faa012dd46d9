// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/force/hexahedron_rotation.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Hexahedra of a grid over a surface as what they are made of: finer cells, each as stiff and as heavy as it
// is filled. What HexahedronCompositeFEMForceField, its mass and its mapping have in common.
namespace sinew {

/// How the corners of finer cells follow those of the cell that they are in.
///   condensed  as in the static equilibrium of the finer cells, all other points being free, in which empty
///              cells are rigid. Of that, points on an edge or a face follow the corners of that alone, along
///              each axis by itself, with weights above 0 and of sum 1, so that neighbours fit (Nesme, Kry,
///              Jerabkova, Faure 2009)
///   trilinear  along straight lines, as if the material were one (Nesme, Payan, Faure 2006)
enum class CellInterpolation { condensed, trilinear };
inline constexpr std::array<std::string_view, 2> enum_names(CellInterpolation) {
  return {"condensed", "trilinear"};
}

/// What settles the weights. Young's modulus does not.
struct CellComposition {
  std::optional<int> levels{};
  double poissonRatio = 0.45;
  HexahedronMethod method = HexahedronMethod::large;
  CellInterpolation interpolation = CellInterpolation::condensed;
  bool finestToCoarse = false, complete = false;
};

/// Fields of a component with nbVirtualFinerLevels, poissonRatio, interpolation and finestToCoarse.
template <class T, class... More>
constexpr auto composite_cell_fields(More... more) {
  return field_list(field("nbVirtualFinerLevels",
                          &T::nbVirtualFinerLevels,
                          "",
                          "how many of the finer levels of the grid count; all, where it is not given",
                          range::closed(0, 24)),
                    field("poissonRatio",
                          &T::poissonRatio,
                          "",
                          "lateral contraction over extension; 0.5 is incompressible",
                          range::open(-1, 0.5)),
                    field("interpolation",
                          &T::interpolation,
                          "",
                          "how finer cells follow the corners of a hexahedron: condensed: as in their "
                          "equilibrium; trilinear: as if the material were one"),
                    field("finestToCoarse",
                          &T::finestToCoarse,
                          "",
                          "whether the finest cells follow the corners directly; else level by level"),
                    more...);
}
template <class T>
constexpr auto hexahedron_method_field() {
  return field("method",
               &T::method,
               "",
               "rotation of an element: large: of a frame on two of its mean edges; polar: the nearest to "
               "these, as in SOFA; small: none, linear elasticity; nearest: the nearest to its deformation");
}
template <class T>
CellComposition cell_composition(T const& t) {
  CellComposition c;
  c.levels = t.nbVirtualFinerLevels;
  c.poissonRatio = t.poissonRatio;
  c.interpolation = t.interpolation;
  c.finestToCoarse = t.finestToCoarse;
  if constexpr (requires { t.method; }) c.method = t.method;
  if constexpr (requires { t.completeInterpolation; }) c.complete = t.completeInterpolation;
  return c;
}

/// How a hexahedron turns: by the mean of the deformation where it is stiff, so that corners that hardly
/// any of its cells follow do not turn it. A = sum_m x_m slopes_m, with slopes_m the mean over its finest
/// cells, by their stiffness, of the derivatives of the shape function of corner m by the coordinates of the
/// reference cube; where all cells are alike, those in its centre.
struct HexahedronFrame {
  HexahedronMethod method;
  Eigen::Matrix<double, 8, 3> slopes;
  Eigen::Matrix3d rest, center;  // frame of the method at rest, A_rest^-1

  Eigen::Matrix3d jacobian(Eigen::Vector3d const (&x)[8]) const;
  /// From the rest frame of the method to the world.
  Eigen::Matrix3d rotation(Eigen::Vector3d const (&x)[8]) const;
  /// Its change by the displacements of the corners: spin = sum_m by[m] dx_m, dR = [spin] R.
  std::array<Eigen::Matrix3d, 8> spin(Eigen::Vector3d const (&x)[8]) const;
};

class CompositeCells {
 public:
  using Matrix24 = Eigen::Matrix<double, 24, 24>;
  using Matrix8 = Eigen::Matrix<double, 8, 8>;

  /// How the corners of a finest cell follow those of the hexahedron, as displacements in its rest frame.
  struct FinestCell {
    Index cell;
    Matrix24 weights;
  };
  struct Cell {
    Matrix24 stiffness;  // for 1 Pa, in the rest frame of the method
    Matrix8 mass;        // for 1 kg/m^3, times the identity
    HexahedronFrame frame;
    std::vector<FinestCell> finest{};
  };

  /// Throws Error where the topology has no hexahedra, or fewer finer levels.
  CompositeCells(std::string where, TopologyView const& topology, CellComposition const& composition);

  /// A hexahedron, whose corners at rest are x. Throws Error where it is flat or inside out, and where it is
  /// no box though it has finer cells. `finest` is filled where it is asked for.
  Cell cell(std::size_t hexahedron, Eigen::Vector3d const (&x)[8], bool finest) const;

  /// The frame of a hexahedron alone, whose corners at rest are x.
  HexahedronFrame frame(std::size_t hexahedron, Eigen::Vector3d const (&x)[8]) const;

  /// How many finer levels count, and the finest of these; none where the hexahedra are the finest.
  std::size_t levels() const { return levels_; }
  CellLevel const* finestLevel() const { return levels_ > 0 ? &topology_.levels[levels_ - 1] : nullptr; }

 private:
  // what is known of a cell; `uniform`: it is full of one material
  struct Part {
    Matrix24 stiffness;
    Matrix8 mass;
    double fill = 1, massFill = 1;
    bool uniform = true;
    std::vector<FinestCell> finest{};
  };
  // a part of a cell of n x n x n: what it is, where it lies, its points
  struct Member {
    Part part;
    Eigen::Vector3i place;
    Hexahedron points;
  };
  // of the box at level 0, for 1 Pa and 1 kg/m^3, in its axes
  struct Box {
    Matrix24 stiffness;
    Matrix8 mass;
    bool finest;
  };

  std::string where_;
  TopologyView topology_;
  CellComposition composition_;
  std::size_t levels_ = 0;
  std::vector<std::vector<int>> first_{}, order_{};  // of each level: cells by what they are a part of

  Part partOf(Box const& box, std::size_t level, Index cell) const;
  void collect(Box const& box, std::size_t level, Index cell, std::size_t until, Eigen::Vector3i const& place,
               std::vector<Member>& members) const;
  Part merged(Box const& box, double scale, int n, std::vector<Member>& members) const;
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/cross_matrix.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sinew {

namespace detail {

/// Weights of the eight corners at a place of a cell, whose coordinates are 0 to 1.
SINEW_ONCE Eigen::Matrix<double, 8, 1> trilinear_weights(Eigen::Vector3d const& place) {
  return MultilinearShape<3>(place).weights;
}

}  // namespace detail

SINEW_ONCE Eigen::Matrix3d HexahedronFrame::jacobian(Eigen::Vector3d const (&x)[8]) const {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  for (int m = 0; m < 8; ++m) a += (x[m] - x[0]) * slopes.row(m);
  return a;
}
SINEW_ONCE Eigen::Matrix3d HexahedronFrame::rotation(Eigen::Vector3d const (&x)[8]) const {
  if (method == HexahedronMethod::small) return Eigen::Matrix3d::Identity();
  return rotation_of_jacobian<double>(method, center, jacobian(x));
}

/// large: with a_0, a_1 the first columns of A and e_k the axes of the frame,
///   e_2.spin = e_1.da_0/|a_0|,  e_1.spin = -e_2.da_0/|a_0|,
///   e_0.spin = (e_2.da_1 + (e_0.a_1) e_1.spin)/(e_1.a_1)
/// nearest and polar: with F = A C, C = A_rest^-1 or I, and M = F R',
///   (tr(M) I - M) spin = sum_c r_c x dF_c
SINEW_ONCE std::array<Eigen::Matrix3d, 8> HexahedronFrame::spin(Eigen::Vector3d const (&x)[8]) const {
  using Eigen::Matrix3d, Eigen::Vector3d;
  Matrix3d byColumn[3];  // of A
  for (auto& m : byColumn) m.setZero();
  const Matrix3d a = jacobian(x), r = rotation(x);
  if (method == HexahedronMethod::large) {
    const double length = a.col(0).norm();
    const Vector3d e0 = r.col(0), e1 = r.col(1), e2 = r.col(2);
    const Eigen::RowVector3d second = -e2.transpose() / length;
    byColumn[0] =
        e2 * e1.transpose() / length + e1 * second + e0 * (e0.dot(a.col(1)) / e1.dot(a.col(1)) * second);
    byColumn[1] = e0 * e2.transpose() / e1.dot(a.col(1));
  } else if (method != HexahedronMethod::small) {
    const Matrix3d c = method == HexahedronMethod::polar ? Matrix3d(Matrix3d::Identity()) : center;
    const Matrix3d m = a * c * r.transpose(), symmetric = (m + m.transpose()) / 2;
    const Matrix3d inverse = (m.trace() * Matrix3d::Identity() - symmetric).inverse();
    for (int k = 0; k < 3; ++k) byColumn[k] = inverse * cross_matrix(Vector3d(r * c.row(k).transpose()));
  }
  std::array<Matrix3d, 8> by;
  for (int m = 0; m < 8; ++m)
    by[std::size_t(m)] = slopes(m, 0) * byColumn[0] + slopes(m, 1) * byColumn[1] + slopes(m, 2) * byColumn[2];
  return by;
}

SINEW_ONCE CompositeCells::CompositeCells(std::string where, TopologyView const& topology,
                                          CellComposition const& composition)
    : where_(std::move(where)), topology_(topology), composition_(composition) {
  if (topology.hexahedra.empty())
    throw Error(where_,
                "the topology has no hexahedron; give the node a SparseGridTopology, a "
                "SparseGridRamificationTopology or a SparseGridMultipleTopology");
  levels_ = composition.levels ? std::size_t(*composition.levels) : topology.levels.size();
  if (levels_ > topology.levels.size())
    throw Error(
        where_,
        text("nbVirtualFinerLevels is ",
             levels_,
             ", but the grid has ",
             topology.levels.size(),
             " finer levels; give the grid as many by its nbVirtualFinerLevels, or ask for fewer here"));
  if (composition.finestToCoarse && levels_ > 3)
    throw Error(where_,
                text("finestToCoarse takes three finer levels at most, of 512 cells, and these are ",
                     levels_,
                     "; ask for fewer by nbVirtualFinerLevels, or go level by level"));
  for (std::size_t level = 0; level < levels_; ++level) {
    auto const& parents = topology.levels[level].parents;
    const std::size_t n = level == 0 ? topology.hexahedra.size() : topology.levels[level - 1].parents.size();
    auto& first = first_.emplace_back(n + 1, 0);
    auto& order = order_.emplace_back(parents.size());
    for (const Index p : parents) ++first[std::size_t(p) + 1];
    for (std::size_t i = 0; i < n; ++i) first[i + 1] += first[i];
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t c = 0; c < parents.size(); ++c)
      order[std::size_t(next[std::size_t(parents[c])]++)] = int(c);
  }
}

SINEW_ONCE HexahedronFrame CompositeCells::frame(std::size_t hexahedron,
                                                 Eigen::Vector3d const (&x)[8]) const {
  HexahedronFrame frame;
  frame.method = composition_.method;
  Eigen::Matrix<double, 8, 3> sum = sum.Zero();
  double all = 0;
  // of a cell: the derivatives in its centre, which are their mean over it
  auto add = [&](double stiff, Eigen::Vector3d const& low, double size) {
    const Eigen::Vector3d middle = low + Eigen::Vector3d::Constant(size / 2);
    sum += stiff * 0.5 * MultilinearShape<3>(middle).derivatives;
    all += stiff;
  };
  auto visit = [&](auto&& self, std::size_t level, Index cell, Eigen::Vector3d const& low) -> void {
    const double size = std::ldexp(1.0, -int(level));
    if (level == levels_)
      return add(level == 0 ? 1 : topology_.levels[level - 1].fill[std::size_t(cell)], low, size);
    for (int c = first_[level][std::size_t(cell)]; c < first_[level][std::size_t(cell) + 1]; ++c) {
      const int child = order_[level][std::size_t(c)];
      Eigen::Vector3d corner = low;
      for (int k = 0; k < 3; ++k)
        corner[k] += size / 2 * hexahedronCorners[topology_.levels[level].octants[std::size_t(child)]][k];
      self(self, level + 1, child, corner);
    }
  };
  visit(visit, 0, Index(hexahedron), Eigen::Vector3d::Zero());
  if (!(all > 0)) sum.setZero(), all = 0, add(1, Eigen::Vector3d::Zero(), 1);
  frame.slopes = sum / all;
  const Eigen::Matrix3d jacobian = frame.jacobian(x);
  frame.rest = hexahedron_rest_frame(frame.method, jacobian);
  frame.center = jacobian.inverse();
  return frame;
}

SINEW_ONCE CompositeCells::Cell CompositeCells::cell(std::size_t hexahedron, Eigen::Vector3d const (&x)[8],
                                                     bool finest) const {
  using Eigen::Matrix3d, Eigen::Vector3d;
  using Fem = HexahedronFEM<Vec3d>;
  auto refuse = [&](std::string_view why) -> void {
    throw Error(where_, text("hexahedron ", hexahedron, ' ', why));
  };
  const HexahedronMethod method = composition_.method;
  HexahedronFrame turns = frame(hexahedron, x);
  const Matrix3d jacobian = hexahedron_jacobian<double>(x), frame = turns.rest;
  // the axes of the box, where the hexahedron is made of finer ones; else those of the frame
  Matrix3d axes = frame;
  Vector3d y[8];
  if (levels_ > 0) {
    for (int k = 0; k < 3; ++k) axes.col(k) = jacobian.col(k).normalized();
    const double longest = jacobian.colwise().norm().maxCoeff();
    Matrix3d const& a = axes;
    if (!((a.transpose() * a - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-5) || !(a.determinant() > 0))
      refuse(
          "is no box, or inside out; it is made of finer cells, so let the state move, turn and scale the "
          "grid along its axes only");
    for (std::size_t k = 0; k < 8; ++k) {
      Vector3d corner = x[0];
      for (int c = 0; c < 3; ++c) corner += 2 * hexahedronCorners[k][c] * jacobian.col(c);
      if (!((corner - x[k]).norm() < 1e-5 * longest))
        refuse("is no box; it is made of finer cells, so give the state the positions of the grid");
    }
  }
  for (int k = 0; k < 8; ++k) y[k] = axes.transpose() * (x[k] - x[0]);
  const LameModuli moduli = lame_moduli(1, composition_.poissonRatio);
  const auto rest = Fem::restOf(y, moduli.mu, moduli.lambda, HexahedronMethod::small);
  const double longest = (y[6] - y[0]).norm();
  for (const double w : rest.weight)
    if (!(w > 1e-12 * longest * longest * longest)) refuse("is flat, inside out or twisted");

  Box box;
  box.finest = finest;
  Fem law{HexahedronMethod::small, Fem::isParallelepiped(y)};
  for (int i = 0; i < 8; ++i)
    for (int j = i; j < 8; ++j) {
      const Matrix3d block = -law.block(rest, {.rotation = Matrix3d::Identity()}, i, j, 1, 0);
      box.stiffness.block<3, 3>(3 * i, 3 * j) = block;
      box.stiffness.block<3, 3>(3 * j, 3 * i) = block.transpose();
    }
  Eigen::Matrix<double, 3, 8> corners;
  for (int k = 0; k < 8; ++k) corners.col(k) = y[k];
  box.mass = multilinear_mass<3>(corners);

  Part part = partOf(box, 0, Index(hexahedron));
  Cell cell{part.stiffness, part.mass, turns, std::move(part.finest)};
  const Matrix3d turn = frame.transpose() * axes;
  auto turned = [&](Matrix24& m) {
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        m.block<3, 3>(3 * i, 3 * j) = (turn * m.block<3, 3>(3 * i, 3 * j) * turn.transpose()).eval();
  };
  turned(cell.stiffness);
  for (auto& f : cell.finest) turned(f.weights);

  // K is taken of what is left of a displacement when the element has turned with it: P'KP, (P u)_k = u_k -
  // spin(u) x y_k. That is what the element sees, and so nothing that turns it as a whole costs energy.
  for (int k = 0; k < 8; ++k) y[k] = frame.transpose() * (x[k] - x[0]);
  if (method == HexahedronMethod::small) turns.method = HexahedronMethod::nearest;
  turns.center = turns.jacobian(y).inverse();
  const auto spin = turns.spin(y);
  Matrix24 project = Matrix24::Identity();
  for (int k = 0; k < 8; ++k)
    for (int m = 0; m < 8; ++m)
      project.block<3, 3>(3 * k, 3 * m) += cross_matrix(y[k]) * spin[std::size_t(m)];
  cell.stiffness = (project.transpose() * cell.stiffness * project).eval();
  return cell;
}

SINEW_ONCE CompositeCells::Part CompositeCells::partOf(Box const& box, std::size_t level, Index cell) const {
  const double scale = std::ldexp(1.0, -int(level));  // length over that of the box
  if (level == levels_) {
    std::span<double const> fills = topology_.fill, masses = topology_.massFill;
    if (level > 0) fills = topology_.levels[level - 1].fill, masses = topology_.levels[level - 1].massFill;
    Part part;
    if (!fills.empty()) part.fill = fills[std::size_t(cell)];
    if (!masses.empty()) part.massFill = masses[std::size_t(cell)];
    part.stiffness = part.fill * scale * box.stiffness;
    part.mass = part.massFill * scale * scale * scale * box.mass;
    if (box.finest) part.finest.push_back({cell, Matrix24::Identity()});
    return part;
  }
  const std::size_t until = composition_.finestToCoarse ? levels_ : level + 1;
  std::vector<Member> members;
  collect(box, level, cell, until, Eigen::Vector3i::Zero(), members);
  return merged(box, scale, 1 << (until - level), members);
}

SINEW_ONCE void CompositeCells::collect(Box const& box, std::size_t level, Index cell, std::size_t until,
                                        Eigen::Vector3i const& place, std::vector<Member>& members) const {
  CellLevel const& next = topology_.levels[level];
  for (int c = first_[level][std::size_t(cell)]; c < first_[level][std::size_t(cell) + 1]; ++c) {
    const auto child = std::size_t(order_[level][std::size_t(c)]);
    Eigen::Vector3i at = 2 * place;
    for (int k = 0; k < 3; ++k) at[k] += hexahedronCorners[next.octants[child]][k];
    if (level + 1 < until)
      collect(box, level + 1, Index(child), until, at, members);
    else
      members.push_back({partOf(box, level + 1, Index(child)), at, next.hexahedra[child]});
  }
}

SINEW_ONCE CompositeCells::Part CompositeCells::merged(Box const& box, double scale, int n,
                                                       std::vector<Member>& members) const {
  using Eigen::MatrixXd, Eigen::Vector3i;
  // the points, by place and number; where a place has none, one of no cell
  auto placeOf = [n](Vector3i const& cell, std::size_t k) {
    int place = 0;
    for (int c = 2; c >= 0; --c) place = (n + 1) * place + cell[c] + hexahedronCorners[k][c];
    return place;
  };
  const int places = (n + 1) * (n + 1) * (n + 1);
  std::vector<std::pair<int, Index>> points;
  std::vector<bool> taken(std::size_t(places), false), full(std::size_t(n * n * n), false);
  for (auto const& m : members) {
    full[std::size_t((m.place[2] * n + m.place[1]) * n + m.place[0])] = true;
    for (std::size_t k = 0; k < 8; ++k) {
      points.push_back({placeOf(m.place, k), m.points[k]});
      taken[std::size_t(points.back().first)] = true;
    }
  }
  for (int p = 0; p < places; ++p)
    if (!taken[std::size_t(p)]) points.push_back({p, -1});
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const int count = int(points.size());
  auto numberOf = [&](int place, Index point) {
    return int(std::lower_bound(points.begin(), points.end(), std::pair(place, point)) - points.begin());
  };
  auto coordinates = [&](int point) {
    const int p = points[std::size_t(point)].first;
    return Vector3i(p % (n + 1), p / (n + 1) % (n + 1), p / ((n + 1) * (n + 1)));
  };

  Part part;
  part.uniform = int(members.size()) == n * n * n && count == places;
  for (auto const& m : members)
    part.uniform = part.uniform && m.part.uniform && m.part.fill == members[0].part.fill &&
                   m.part.massFill == members[0].part.massFill;
  part.fill = members.empty() ? 0 : members[0].part.fill;
  part.massFill = members.empty() ? 0 : members[0].part.massFill;

  // of one material, equilibrium is trilinear, but for what is left out of it
  Eigen::Matrix<double, Eigen::Dynamic, 24> weights(3 * count, 24);
  weights.setZero();
  for (int p = 0; p < count; ++p) {
    const auto w = detail::trilinear_weights(coordinates(p).cast<double>() / n);
    for (int k = 0; k < 8; ++k)
      for (int c = 0; c < 3; ++c) weights(3 * p + c, 3 * k + c) = w[k];
  }
  Eigen::Matrix<double, Eigen::Dynamic, 24> shown = weights;
  const bool complete = composition_.complete && box.finest;
  const double smaller = scale / n;
  if (composition_.interpolation == CellInterpolation::condensed && (!part.uniform || complete)) {
    // the equilibrium: empty cells are stiffer than all others, by so much that rounding does not show, and
    // cells without stiffness have a trace of it
    double stiffest = 0;
    for (auto const& m : members)
      stiffest = std::max(stiffest, m.part.stiffness.trace() / (smaller * box.stiffness.trace()));
    MatrixXd K = MatrixXd::Zero(3 * count, 3 * count);
    auto add = [&](Matrix24 const& k, double factor, std::array<int, 8> const& at) {
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
          K.block<3, 3>(3 * at[std::size_t(i)], 3 * at[std::size_t(j)]) +=
              factor * k.block<3, 3>(3 * i, 3 * j);
    };
    for (auto const& m : members) {
      std::array<int, 8> at;
      for (std::size_t k = 0; k < 8; ++k) at[k] = numberOf(placeOf(m.place, k), m.points[k]);
      add(m.part.stiffness, 1, at);
      add(box.stiffness, 1e-10 * stiffest * smaller, at);
    }
    for (int z = 0, c = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x, ++c) {
          if (full[std::size_t(c)]) continue;
          std::array<int, 8> at;
          for (std::size_t k = 0; k < 8; ++k) at[k] = numberOf(placeOf({x, y, z}, k), -1);
          add(box.stiffness, 1e4 * stiffest * smaller, at);
        }
    std::vector<int> freePoints;
    MatrixXd corners = MatrixXd::Zero(3 * count, 24);  // the displacements that are given
    for (int p = 0; p < count; ++p) {
      const Vector3i at = coordinates(p);
      if (((at.array() == 0) || (at.array() == n)).all())
        corners.middleRows<3>(3 * p) = weights.middleRows<3>(3 * p);
      else
        freePoints.push_back(p);
    }
    const auto rows = Eigen::Index(3 * freePoints.size());
    MatrixXd inner(rows, rows), load(rows, 24);
    const MatrixXd pulls = K * corners;
    for (std::size_t i = 0; i < freePoints.size(); ++i) {
      load.middleRows<3>(Eigen::Index(3 * i)) = -pulls.middleRows<3>(3 * freePoints[i]);
      for (std::size_t j = 0; j < freePoints.size(); ++j)
        inner.block<3, 3>(Eigen::Index(3 * i), Eigen::Index(3 * j)) =
            K.block<3, 3>(3 * freePoints[i], 3 * freePoints[j]);
    }
    const Eigen::LDLT<MatrixXd> solver(inner);
    MatrixXd found(rows, 24);
    for (int k = 0; k < 24; ++k)  // a column each: nvcc refuses Eigen's triangular solves of several at once
      found.col(k) = solver.solve(load.col(k));
    if (stiffest > 0 && found.allFinite())
      for (std::size_t i = 0; i < freePoints.size(); ++i) {
        const int p = freePoints[i];
        if (complete) shown.middleRows<3>(3 * p) = found.middleRows<3>(Eigen::Index(3 * i));
        for (int c = 0; c < 3; ++c) {
          // corners of the edge or face on which the point lies are those with a trilinear weight; each keeps
          // a trace of it, so that none is left without mass
          Eigen::Matrix<double, 1, 24> row = weights.row(3 * p + c);
          for (int k = 0; k < 24; ++k)
            if (row[k] > 0) row[k] = std::max(found(Eigen::Index(3 * i) + c, k), 1e-4 * row[k]);
          weights.row(3 * p + c) = row / row.sum();
        }
      }
    if (!complete) shown = weights;
  }

  part.stiffness.setZero();
  part.mass.setZero();
  for (auto& m : members) {
    Matrix24 own, ofShown;
    for (std::size_t k = 0; k < 8; ++k) {
      const int p = numberOf(placeOf(m.place, k), m.points[k]);
      own.middleRows<3>(Eigen::Index(3 * k)) = weights.middleRows<3>(3 * p);
      ofShown.middleRows<3>(Eigen::Index(3 * k)) = shown.middleRows<3>(3 * p);
    }
    part.stiffness += own.transpose() * m.part.stiffness * own;
    for (int c = 0; c < 3; ++c) {  // the mean of the axes
      Matrix8 w;
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) w(i, j) = own(3 * i + c, 3 * j + c);
      part.mass += w.transpose() * m.part.mass * w / 3;
    }
    for (auto& f : m.part.finest) part.finest.push_back({f.cell, f.weights * ofShown});
  }
  return part;
}

}  // namespace sinew
#endif
