// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/core/element_force.hpp>
#include <sinew/gpu/distributed/devices.hpp>
#include <sinew/gpu/distributed/loops.hpp>
#include <sinew/gpu/distributed/partition.hpp>
#include <sinew/gpu/fused/components.hpp>
#include <sinew/gpu/gpu.hpp>
#include <sinew/scene/components_of.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <future>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

namespace detail {

template <class C>
struct IsAnyState : std::bool_constant<HasRole<C, role::State>> {};
template <class C>
struct IsImplicitEuler : std::is_same<C, EulerImplicitSolver> {};
template <class C>
struct IsExplicitEuler : std::is_same<C, EulerExplicitSolver> {};
template <class C>
struct IsAnyCG : std::false_type {};
template <class Matrix>
struct IsAnyCG<CGLinearSolver<Matrix>> : std::true_type {};
/// What a body over several devices has no place for.
template <class C>
struct IsForeignToParts
    : std::bool_constant<IsMoreThanABody<C>::value || HasRole<C, role::AnimationLoop> ||
                         HasRole<C, role::ConstraintSolver> || HasRole<C, role::CollisionPipeline> ||
                         (HasRole<C, role::OdeSolver> && !IsImplicitEuler<C>::value &&
                          !IsExplicitEuler<C>::value) ||
                         (HasRole<C, role::LinearSolver> && !IsAnyCG<C>::value)> {};
/// What of a scene is stepped.
template <class C>
struct IsDistributed : std::disjunction<IsState<C>, IsMass<C>, IsForceField<C>, IsConstraint<C>, IsGravity<C>,
                                        IsImplicitEuler<C>, IsExplicitEuler<C>, IsAnyCG<C>> {};

}  // namespace detail

template <>
inline constexpr std::string_view fused_fields<EulerExplicitSolver> = "symplectic";

/// The body of a typed scene, cut into parts that are on several devices, one after another of a list: each
/// has the elements of its points, and sends what it has found of the points at its border to those that
/// share elements with them, while it goes on with the others. Devices write each other's memory and wait for
/// each other; the host only queues.
///
/// The scene has one body of points on the device (CudaVec3f or CudaVec3d), a lumped mass, force fields that
/// are element laws, fixed points, and EulerImplicitSolver with a CGLinearSolver, whose matrix is assembled
/// in each part, or EulerExplicitSolver. What else it has (visual models) is left to the Simulation: store()
/// brings the state back to it. The result is that of Simulation::animate but for rounding: sums are in
/// another order, the same one in every run.
///
/// Throws Error where a device is not there or cannot write another's memory, where a field of a component is
/// given that has no place here (fused_fields), and where a device has too little memory.
template <class Root>
class DistributedSimulation {
  static constexpr char const* name = "DistributedSimulation";
  using All = decltype(components_of(std::declval<Root&>()));
  template <template <class> class Test>
  using Those = decltype(components_that<Test>(std::declval<All>()));
  template <template <class> class Test>
  static constexpr std::size_t count = std::tuple_size_v<Those<Test>>;
  static constexpr bool implicit = count<detail::IsImplicitEuler> == 1;
  static_assert(count<detail::IsState> == 1 && count<detail::IsAnyState> == 1 && count<detail::IsMass> == 1 &&
                    count<detail::IsImplicitEuler> + count<detail::IsExplicitEuler> == 1 &&
                    (count<detail::IsAnyCG> == 1 || !implicit),
                "Sinew: a scene over several devices has one state, on the device, one mass, and one "
                "EulerImplicitSolver with a CGLinearSolver or one EulerExplicitSolver; others are stepped by "
                "Simulation.");
  static_assert(count<detail::IsForeignToParts> == 0,
                "Sinew: over several devices there are no collisions, constraints by multipliers, "
                "interactions, tools that carve, further solvers, forces that steps change, and what acts "
                "before a step; such a scene is stepped by Simulation.");
  using State = std::remove_pointer_t<std::tuple_element_t<0, Those<detail::IsState>>>;
  using D = typename State::DataTypes;
  static_assert(!D::rigid && D::size == 3,
                "Sinew: over several devices there are points in space: CudaVec3f or CudaVec3d.");
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;

  /// The elements of a force field that a part has.
  template <class Field>
  struct FieldPart {
    static_assert(takes_elements<Field>,
                  "Sinew: over several devices force fields are element laws; others are for Simulation.");
    using Driver = typename Field::Driver;
    typename Driver::Law law{};
    Driver driver{};
    std::vector<int> numbers{};  // of the elements in the body
    std::size_t whole = 0;       // elements of the body

    // the driver's elements are those of which `is` holds
    template <class Is>
    void take(Field const& field, Is&& is) {
      auto const& all = field.driver.elements;
      whole = all.size();
      for (std::size_t e = 0; e < whole; ++e)
        if (is(all[e])) {
          numbers.push_back(int(e));
          driver.elements.push_back(all[e]);
        }
    }
    std::vector<typename Driver::Rest> restOf(Field const& field) const {
      auto const& all = std::as_const(field.driver.rest).host();
      std::vector<typename Driver::Rest> own;
      own.reserve(numbers.size());
      for (const int e : numbers) own.push_back(all[std::size_t(e)]);
      return own;
    }
  };
  template <class... F>
  static std::tuple<FieldPart<F>...> fieldPartsOf(std::tuple<F*...> const&);
  using Fields = decltype(fieldPartsOf(std::declval<Those<detail::IsForceField>>()));
  static constexpr bool usesVelocity = []<class... F>(std::tuple<F...>*) {
    return (F::Driver::Law::usesVelocity || ... || false);
  }(static_cast<Fields*>(nullptr));

  struct Part {
    BodyPart body{};
    Fields fields{};
    BlockRows<D> rows{};
    DeviceVector<Coord> x{};
    DeviceVector<Deriv> v{}, f{}, dv{}, r{}, p{}, q{}, diagonal{};
    DeviceVector<Real> mass{};
    DeviceVector<unsigned char> held{};
    DeviceVector<int> first{};
    DeviceVector<BodyPart::Place> places{};
    DeviceVector<double> numbers{};

    std::size_t own() const { return std::size_t(body.own); }
    std::size_t all() const { return body.points.size(); }
  };

 public:
  /// The body of an initialised simulation, in as many parts as devices are given; each may be there again.
  explicit DistributedSimulation(Simulation<Root>& simulation, std::vector<int> devices = all_devices())
      : group_(std::move(devices), name) {
    const All all = components_of(simulation.root());
    auto const& state = *std::get<0>(components_that<detail::IsState>(all));
    const std::size_t points = state.size();
    std::vector<Eigen::Vector3d> where;
    for (auto const& x : state.position.host()) {
      if (!x.allFinite())
        throw Error(name, text("the position of point ", where.size(), " is not a finite number"));
      where.push_back(x.template cast<double>());
    }
    const auto fields = components_that<detail::IsForceField>(all);
    BodyPartition cut(where, group_.size(), [&](auto&& f) {
      std::apply(
          [&](auto*... field) {
            (
                [&] {
                  for (auto const& e : field->driver.elements) f(e);
                }(),
                ...);
          },
          fields);
    });
    partOf_ = std::move(cut.partOf);
    parts_.resize(group_.size());
    std::vector<unsigned char> held(points, 0);
    std::apply([&](auto*... c) { (detail::note_held<D>(*c, held), ...); },
               components_that<detail::IsConstraint>(all));
    // the lists of a part are long in the making, so that each has a thread of its own for it; what all read
    // is on the host by then
    std::apply([](auto const*... field) { (field->driver.rest.host(), ...); }, fields);
    std::vector<std::future<void>> making;
    for (std::size_t k = 0; k < parts_.size(); ++k)
      making.push_back(std::async(std::launch::async, [&, k] {
        const UseDevice use(group_.device(k));
        makePart(k, std::move(cut.parts[k]), all, held);
      }));
    for (auto& part : making) part.wait();
    for (auto& part : making) part.get();
    load(simulation);
  }

  /// State, masses, materials, gravity and settings of solvers are those of a simulation of the same scene.
  /// Throws Error where its points or elements are not as many.
  void load(Simulation<Root>& from) {
    const All all = components_of(from.root());
    std::apply([](auto*... c) { (detail::refuse_other_fields(*c, name), ...); },
               components_that<detail::IsDistributed>(all));
    auto const& state = *std::get<0>(components_that<detail::IsState>(all));
    if (state.size() != partOf_.size())
      throw Error(text(name, "::load"),
                  text("the body has ",
                       state.size(),
                       " points, that of the parts ",
                       partOf_.size(),
                       "; load a simulation of the same scene"));
    auto const& x = state.position.host();
    auto const& v = state.velocity.host();
    auto const& mass = *std::get<0>(components_that<detail::IsMass>(all));
    gravity_ = Deriv::Zero();
    std::apply([&](auto*... c) { ((gravity_ = c->gravity.template cast<Real>()), ...); },
               components_that<detail::IsGravity>(all));
    group_.wait();
    group_.each([&](std::size_t k) {
      Part& part = parts_[k];
      withFields(all, part, [&](auto& mine, auto const& field) {
        if (field.driver.elements.size() != mine.whole)
          throw Error(text(name, "::load"),
                      text(component_name<std::decay_t<decltype(field)>>(),
                           " has ",
                           field.driver.elements.size(),
                           " elements, that of the parts ",
                           mine.whole,
                           "; load a simulation of the same scene"));
        mine.law = law_of(field);
        mine.driver.rest = mine.restOf(field);
      });
      auto of = [&](auto&& value) {
        std::vector<std::decay_t<decltype(value(std::size_t{}))>> own;
        own.reserve(part.all());
        for (const int i : part.body.points) own.push_back(value(std::size_t(i)));
        return own;
      };
      part.x = of([&](std::size_t i) -> Coord { return x[i]; });
      part.v = of([&](std::size_t i) -> Deriv { return v[i]; });
      part.mass = of([&](std::size_t i) { return Real(mass.lumped.at(i)); });
      // where others will write, it has to be now
      part.x.device();
      part.v.device();
      if constexpr (implicit) part.p.device();
    });
    group_.wait();
    if constexpr (implicit) {
      ode_ = *std::get<0>(components_that<detail::IsImplicitEuler>(all));
      auto const& cg = *std::get<0>(components_that<detail::IsAnyCG>(all));
      iterations_ = cg.iterations;
      tolerance_ = cg.tolerance;
      threshold_ = cg.threshold;
      const std::size_t numbers = group_.size() * (2 * std::size_t(iterations_) + 1);
      group_.each([&](std::size_t k) { parts_[k].numbers.overwrite(numbers); });
    } else {
      ode_ = *std::get<0>(components_that<detail::IsExplicitEuler>(all));
    }
    time_ = from.time();
    step_ = from.step();
  }
  /// A simulation of the same scene takes the state and the time.
  void store(Simulation<Root>& to) const {
    auto& state = *std::get<0>(components_that<detail::IsState>(components_of(to.root())));
    if (state.size() != partOf_.size())
      throw Error(text(name, "::store"), "the body has another number of points; give the same scene");
    Coord* const x = state.position.overwriteOnHost();
    Deriv* const v = state.velocity.overwriteOnHost();
    group_.each([&](std::size_t k) {
      Part const& part = parts_[k];
      auto const& ownX = part.x.host();
      auto const& ownV = part.v.host();
      for (std::size_t i = 0; i < part.own(); ++i) {
        x[part.body.points[i]] = ownX[i];
        v[part.body.points[i]] = ownV[i];
      }
    });
    to.continueFrom(time_, step_);
  }

  /// Makes steps of dt seconds. Returns before they are done, but where the linear solver has a tolerance:
  /// the host then looks every tenth iteration whether more are needed. Throws Error where dt is no positive
  /// number.
  void animate(double dt, int steps = 1) {
    if (!(dt > 0) || !std::isfinite(dt))
      throw Error(text(name, "::animate"),
                  text("dt is ", dt, " s, but must be a finite number greater than 0"));
    if (steps < 0) throw Error(text(name, "::animate"), text(steps, " steps; give 0 or more"));
    for (int i = 0; i < steps; ++i) {
      if constexpr (implicit)
        stepImplicitly(dt);
      else
        stepExplicitly(dt);
      time_ += dt;
      ++step_;
    }
  }
  /// Waits for the steps that were asked for. Throws Error where a position is not finite.
  void finish() {
    group_.wait();
    group_.each([&](std::size_t k) {
      Part& part = parts_[k];
      using NotFinite = typename VectorOperations<D>::NotFinite;
      if (sum_on_host(part.own(), NotFinite{std::as_const(part.x).device()}) == 0) return;
      auto const& x = std::as_const(part.x).host();
      std::size_t i = 0;
      while (i + 1 < part.own() && x[i].allFinite()) ++i;
      throw Error(text("point ", part.body.points[i], ", after step ", step_, " (time ", time_, " s)"),
                  "its position is not a finite number: the simulation diverged; take a smaller dt, more "
                  "damping or a softer material");
    });
  }

  std::size_t parts() const { return parts_.size(); }
  /// Points of a part, and those of others that it has besides.
  std::pair<std::size_t, std::size_t> points(std::size_t part) const {
    return {parts_.at(part).own(), parts_.at(part).all() - parts_.at(part).own()};
  }
  double time() const { return time_; }
  long step() const { return step_; }

 private:
  DeviceGroup group_;
  std::vector<Part> parts_{};
  std::vector<int> partOf_{};
  Deriv gravity_ = Deriv::Zero();
  std::conditional_t<implicit, EulerImplicitSolver, EulerExplicitSolver> ode_{};
  int iterations_ = 0;
  double tolerance_ = 0, threshold_ = 0;
  double time_ = 0;
  long step_ = 0;

  template <class F>
  static void withFields(All const& all, Part& part, F&& f) {
    const auto fields = components_that<detail::IsForceField>(all);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (f(std::get<I>(part.fields), *std::get<I>(fields)), ...);
    }(std::make_index_sequence<std::tuple_size_v<Fields>>{});
  }
  template <class F>
  static void eachField(Part& part, F&& f) {
    std::apply([&](auto&... field) { (f(field), ...); }, part.fields);
  }
  void makePart(std::size_t k, BodyPart body, All const& all, std::vector<unsigned char> const& held) {
    Part& part = parts_[k];
    part.body = std::move(body);
    std::vector<int> local(partOf_.size(), -1);
    for (std::size_t i = 0; i < part.all(); ++i) local[std::size_t(part.body.points[i])] = int(i);
    withFields(all, part, [&](auto& mine, auto const& field) {
      mine.take(field, [&](auto const& points) {
        bool is = false;
        for (const int i : points) is = is || partOf_[std::size_t(i)] == int(k);
        return is;
      });
      for (auto& indices : mine.driver.elements)
        for (int& i : indices) i = local[std::size_t(i)];
      mine.driver.init(std::vector(std::move(mine.driver.elements)), mine.restOf(field));
    });
    part.first = part.body.first;
    part.places = part.body.places;
    std::vector<unsigned char> bits;
    for (const int i : part.body.points) bits.push_back(held[std::size_t(i)]);
    part.held = std::move(bits);
    part.f.overwrite(part.all());
    if constexpr (implicit) {
      for (auto* v : {&part.dv, &part.r, &part.q, &part.diagonal}) v->overwrite(part.all());
      part.p = DeviceVector<Deriv>(part.all(), Deriv(Deriv::Zero()));
      planRows(part);
    }
  }
  static void planRows(Part& part) {
    using Source = typename BlockRows<D>::Source;
    std::vector<Source> sources;
    eachField(part, [&](auto& field) { sources.push_back(Source(field.driver.elements)); });
    part.rows.plan(std::move(sources), part.all());
  }

  // a vector as others write it, `member` of each part
  template <class T>
  distributed::InHalos<T> inHalos(Part& own, DeviceVector<T> Part::*member) {
    distributed::InHalos<T> halos{
        std::as_const(own.first).device(), std::as_const(own.places).device(), own.body.inner, {}};
    for (std::size_t p = 0; p < parts_.size(); ++p) halos.of[p] = (parts_[p].*member).device();
    return halos;
  }
  // body(i) for own points: those of the border first, which send, then the inner ones
  template <class Body>
  static void bordersFirst(Part& part, Body const& body) {
    const int inner = part.body.inner;
    for_each_index(part.own() - std::size_t(inner), distributed::From<Body>{body, inner});
  }
  template <class Body>
  static void innerThen(Part& part, Body const& body) {
    for_each_index(std::size_t(part.body.inner), body);
  }
  // what make(part) does to each point, sent to halos on the way
  template <class Make>
  void sendAndGoOn(Make&& make) {
    group_.each([&](std::size_t k) { bordersFirst(parts_[k], make(parts_[k])); });
    group_.mark();
    group_.each([&](std::size_t k) { innerThen(parts_[k], make(parts_[k])); });
    group_.await();
  }

  // f = m g and the forces of elements
  void forces(Part& part) {
    for_each_index(part.all(),
                   distributed::Weigh<D>{part.f.overwrite(), std::as_const(part.mass).device(), gravity_});
    eachField(part, [&](auto& field) {
      field.driver.addForce(field.law, part.f, std::as_const(part.x), std::as_const(part.v));
    });
  }

  void stepExplicitly(double dt) {
    group_.each([&](std::size_t k) { forces(parts_[k]); });
    group_.sync();  // who is sent to has read its halo
    sendAndGoOn([&](Part& part) {
      return distributed::MoveExplicitly<D>{part.x.device(),
                                            part.v.device(),
                                            std::as_const(part.f).device(),
                                            std::as_const(part.mass).device(),
                                            std::as_const(part.held).device(),
                                            Real(dt),
                                            ode_.symplectic,
                                            usesVelocity,
                                            inHalos(part, &Part::x),
                                            inHalos(part, &Part::v)};
    });
  }

  // where a part puts its sums, number n of all parts
  ToParts toParts(std::size_t k, std::size_t n) {
    ToParts to{{}, int(parts_.size())};
    for (std::size_t p = 0; p < parts_.size(); ++p)
      to.of[p] = parts_[p].numbers.device() + n * parts_.size() + k;
    return to;
  }
  distributed::Scalars scalars(Part& part) {
    double const* const all = part.numbers.device();
    const auto parts = parts_.size();
    return {
        all, all + (std::size_t(iterations_) + 1) * parts, int(parts), tolerance_ * tolerance_, threshold_};
  }

  void stepImplicitly(double dt) {
    const double h = dt, rK = ode_.rayleighStiffness, rM = ode_.rayleighMass;
    group_.each([&](std::size_t k) {
      Part& part = parts_[k];
      forces(part);
      eachField(part, [&](auto& field) {
        field.driver.addDForce(field.law, part.f, std::as_const(part.v), Real(h + rK), Real(0));
      });
      std::size_t source = 0;
      eachField(part, [&](auto& field) {
        part.rows.add(source++, field.law, field.driver.view(), Real(-h * (h + rK)), Real(-h));
      });
      if (source == 0) part.rows.clear();
      for_each_index(part.all(),
                     distributed::Weigh<D>{part.diagonal.overwrite(),
                                           std::as_const(part.mass).device(),
                                           Deriv(Deriv::Constant(Real(1 + h * rM)))});
      part.rows.addDiagonal(std::as_const(part.diagonal).device());
      sum_indices(part.own(),
                  distributed::Begin<D>{std::as_const(part.f).device(),
                                        std::as_const(part.v).device(),
                                        std::as_const(part.mass).device(),
                                        std::as_const(part.held).device(),
                                        Real(h),
                                        Real(rM),
                                        part.dv.device(),
                                        part.r.device(),
                                        part.p.device()},
                  toParts(k, 0));
    });
    group_.sync();
    group_.each([&](std::size_t k) {
      Part& part = parts_[k];
      bordersFirst(part, distributed::Send<Deriv>{std::as_const(part.p).device(), inHalos(part, &Part::p)});
    });
    group_.sync();
    for (int i = 0; i < iterations_; ++i) {
      group_.each([&](std::size_t k) {
        Part& part = parts_[k];
        sum_indices(part.own(),
                    distributed::Product<D>{{std::as_const(part.rows.sliceFirst).device(),
                                             std::as_const(part.rows.column).device(),
                                             part.rows.values.data(),
                                             std::as_const(part.p).device(),
                                             part.q.device()},
                                            std::as_const(part.held).device()},
                    toParts(k, std::size_t(iterations_ + 1 + i)));
      });
      group_.sync();
      group_.each([&](std::size_t k) {
        Part& part = parts_[k];
        using V = VectorOperations<D>;
        sum_indices(3 * part.own(),
                    distributed::Advance<Real>{V::flat(part.dv),
                                               V::flat(part.r),
                                               V::flat(std::as_const(part.p)),
                                               V::flat(std::as_const(part.q)),
                                               scalars(part),
                                               i},
                    toParts(k, std::size_t(i + 1)));
      });
      group_.sync();
      if (i + 1 == iterations_ || solved(i)) break;
      sendAndGoOn([&](Part& part) {
        return distributed::Direction<D>{
            part.p.device(), std::as_const(part.r).device(), scalars(part), i, inHalos(part, &Part::p)};
      });
    }
    sendAndGoOn([&](Part& part) {
      return distributed::MoveImplicitly<D>{part.x.device(),
                                            part.v.device(),
                                            std::as_const(part.dv).device(),
                                            Real(h),
                                            Real(std::exp(-h * ode_.vdamping)),
                                            inHalos(part, &Part::x),
                                            inHalos(part, &Part::v)};
    });
  }
  // whether the host sees, behind iteration i, that there is nothing left to do
  bool solved(int i) {
    if (!(tolerance_ > 0) || i % 10 != 9) return false;
    const UseDevice use(group_.device(0));
    const std::size_t parts = parts_.size();
    double const* const numbers = parts_[0].numbers.device();
    double sums[2] = {0, 0};
    for (const int which : {0, 1}) {
      std::array<double, most_devices> of{};
      copy_to_host(of.data(), numbers + std::size_t(which == 0 ? 0 : i + 1) * parts, parts);
      for (std::size_t p = 0; p < parts; ++p) sums[which] += of[p];
    }
    return !(sums[1] > tolerance_ * tolerance_ * sums[0]);
  }
};

}  // namespace sinew::gpu
