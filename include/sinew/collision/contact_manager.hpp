// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/attachment.hpp>
#include <sinew/collision/contact_assembly.hpp>
#include <sinew/collision/contact_limit.hpp>
#include <sinew/collision/contact_responses.hpp>
#include <sinew/collision/contact_rules.hpp>
#include <sinew/collision/friction_contact_constraint.hpp>
#include <sinew/collision/penalty_contact.hpp>
#include <sinew/collision/stick_contact.hpp>
#include <sinew/collision/stick_contact_constraint.hpp>
#include <sinew/collision/vertex_contacts.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/memory_limit.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sinew {

/// Keeps the contacts from step to step and applies the responses to them: that of a model that names one,
/// else of the first rule that fits the two models, else its own. A contact is known again by the vertices
/// that meet; what its response remembers goes with it. Contacts stand in the order of their keys, whatever
/// the order in which they were found.
///
/// `Responses`: laws of force (ContactLaw), multipliers (ContactConstraint), and what changes components that
/// are touched (TouchResponse). Two models together have the stiffness k1 k2 / (contact distance with the
/// radii of the two) [N/m], the sum of frictions and of dampings, as in SOFA. A response that has a mu gives
/// it where models have no friction; one in its parameters takes the place of that of models, too. A response
/// that has a `managerName` names the class, so that scene files may choose between it and others.
template <class... Responses>
struct ContactManager {
  using Role = role::ContactManager;
  using All = ContactResponses<Responses...>;
  static constexpr std::string_view ownName = All::managerName();
  static constexpr std::string_view className = ownName.empty() ? "DefaultContactManager" : ownName;
  static constexpr std::string_view aliases =
      ownName.empty() ? "CollisionResponse RuleBasedContactManager" : "";

  std::string response = "PenalityContactForceField", responseParams{}, rules{};
  int capacity = 1000, maximumContacts = 200000;
  std::tuple<Responses...> responses{};

  static constexpr auto fields() {
    using M = ContactManager;
    return field_list(
        field("response", &M::response, "", "class of the response to contacts of models that name none"),
        field("responseParams",
              &M::responseParams,
              "",
              "parameters of that response, such as mu=0.5: the coefficient of friction"),
        field(
            "rules",
            &M::rules,
            "",
            "responses of pairs of models, each by three words: two models by name, path, group or *, and a "
            "response with parameters, as in 'tool * StickContactConstraint  1 2 "
            "FrictionContactConstraint?mu=0.3'; nullptr for none"),
        field("capacity",
              &M::capacity,
              "",
              "contacts for which there is room from the start; more are allowed, and make a step allocate",
              range::atLeast(0)),
        field("maximumContacts",
              &M::maximumContacts,
              "",
              "contacts of a step; more are an error, since so many are hardly meant",
              range::atLeast(1)));
  }

  std::vector<Contact> contacts{};  // rising by key

  static constexpr auto state() {
    return field_list(field(
        "contacts", &ContactManager::contacts, "", "contacts of the last step, and what they remember"));
  }

  // of the steps
  std::string path{};  // of itself, for errors
  std::vector<Contact> found{};
  std::vector<CollisionSurface*> surfaces{};  // in the order of the scene, of this step
  std::vector<int> bodies{};                  // of each surface, the first one that is on the same state
  std::vector<int> points{};
  ContactRules answers{};
  ContactAssembly assembly{};
  VertexContacts ofVertices{}, foundVertices{};  // of the last step, and of those that were found
  bool listed = false;                           // whether ofVertices is that of the contacts
  long grown = 0;                                // how often there was no room
  bool couplingChanged = false;                  // since the last step: other vertices meet than before
  std::vector<Attachment> attachments{};         // places that are held from outside
  std::vector<Contact> keptContacts{};           // those that follow a change of the scene, until init
  std::vector<Attachment> keptAttachments{};
  bool couplesAgain = false;                    // whatever the contacts are
  std::vector<ContactKey> keys{}, foundKeys{};  // of contacts, and of those that were found
  std::vector<std::pair<ContactKey, int>> order{};
  std::vector<Contact> sorted{};
  bool byForce = false;  // some contacts are not answered by multipliers
  int lastAttachment = 0;

  void init(std::string const& where, std::vector<CollisionSurface*> const& all, bool again = false) {
    path = where;
    check_memory(where, text("room for ", capacity, " contacts (capacity)"), capacity);
    takeModels(all);
    bodies.clear();
    for (auto const* s : surfaces)
      bodies.push_back(int(std::find_if(surfaces.begin(),
                                        surfaces.end(),
                                        [s](auto const* other) { return other->state == s->state; }) -
                           surfaces.begin()));
    if (again) contacts = std::exchange(keptContacts, {});
    attachments = std::exchange(keptAttachments, {});
    couplesAgain = !contacts.empty() || !attachments.empty();
    found.clear();
    for (auto* list : {&contacts, &found, &sorted}) list->reserve(std::size_t(capacity));
    for (auto* list : {&keys, &foundKeys}) list->reserve(std::size_t(capacity));
    order.reserve(std::size_t(capacity));
    ofVertices.reserve(std::size_t(capacity));
    foundVertices.reserve(std::size_t(capacity));
    listed = false;
    points.reserve(6 * std::size_t(capacity));
    attachments.reserve(8);
    grown = 0;
    answers.read(where,
                 responseParams.empty() ? response : text(response, '?', responseParams),
                 rules,
                 surfaces,
                 &All::choose);
    for (std::size_t i = 0; i < contacts.size(); ++i)
      if (!fits(contacts[i].a) || !fits(contacts[i].b) || contacts[i].response < 0 ||
          contacts[i].response >= All::count)
        throw Error(where,
                    text(component_name<ContactManager>(),
                         ": contact ",
                         i,
                         " of the checkpoint is between primitives that this scene does not have; take the "
                         "checkpoint with the "
                         "scene that it was made of"));
    byForce = coupling(contacts) > 0;
  }

  /// Whether a response by multipliers may answer contacts.
  bool asksForMultipliers() const { return answers.any(&All::isConstraint); }

  /// Whether contacts of two models are answered by multipliers whose violations follow from the motion.
  bool answersMeasuring(int a, int b) const { return All::measuresMotion(answers.find(a, b).place); }
  /// The friction of contacts of two models that a response answers.
  double frictionOf(ResponseChoice const& chosen, CollisionSurface const& a,
                    CollisionSurface const& b) const {
    double friction = a.settings.contactFriction + b.settings.contactFriction;
    All::visit(responses, chosen.place, [&](auto const& r) {
      if constexpr (HasFriction<std::decay_t<decltype(r)>>) {
        if (friction == 0) friction = r.mu;
        if (chosen.friction >= 0) friction = chosen.friction;
      }
    });
    return friction;
  }
  /// Whether no contact is answered otherwise than by multipliers.
  bool asksForMultipliersOnly() const {
    return !answers.any([](int place) { return place >= 0 && !All::isConstraint(place); });
  }

  /// Whether some of it are forces, which ODE solvers see.
  bool acts() const { return byForce || !attachments.empty(); }
  /// Forgets all contacts.
  void reset() {
    couplesAgain = couplesAgain || !contacts.empty() || !attachments.empty();
    contacts.clear();
    listed = byForce = false;
    attachments.clear();
  }

  /// Holds a place from now on: the attachment with a number, which nothing else has.
  void attach(Attachment const& a) {
    attachments.push_back(a);
    couplesAgain = true;
  }
  Attachment* attachment(int id) {
    for (Attachment& a : attachments)
      if (a.id == id) return &a;
    return nullptr;
  }
  /// Releases an attachment; returns whether there was one.
  bool release(int id) {
    const bool held = std::erase_if(attachments, [id](Attachment const& a) { return a.id == id; }) > 0;
    couplesAgain = couplesAgain || held;
    return held;
  }

  /// What touches goes on when vertices go, those of surface s being renumbered by `of(s)`: contacts of what
  /// stays keep what they remember.
  template <class Of>
  void follow(Of&& of) {
    auto stays = [&](Contact& c) {
      for (ContactSide* side : {&c.a, &c.b})
        for (int k = 0; side->surface >= 0 && k < side->corners(); ++k) {
          auto const& renumbering = of(side->surface);
          int& vertex = side->vertices[std::size_t(k)];
          if (!renumbering.stays(vertex)) return false;
          renumbering.renumber(vertex);
        }
      return true;
    };
    keptContacts.clear();
    keptAttachments.clear();
    for (Contact c : contacts)
      if (stays(c)) keptContacts.push_back(c);
    for (Attachment a : attachments)
      if (stays(a.contact)) keptAttachments.push_back(a);
  }

  /// The models that contacts name by number: those of this scene, of which a copy has its own.
  void takeModels(std::vector<CollisionSurface*> const& all) { surfaces = all; }

  /// Updates what the responses remember of the step that has ended; the surfaces are at its end.
  void settle() {
    for (Contact& c : contacts)
      All::visit(responses, c.response, [&](auto const& law) {
        if constexpr (requires { law.settle(c, c.start); }) law.settle(c, displacement(c));
      });
  }

  /// By how much, as the sine of an angle, what is near need not be nearest of all around, so that the
  /// contacts of two models are found together: forces need where bodies touch first, multipliers all that
  /// will.
  double coneOf(int a, int b) const {
    return All::isConstraint(answers.find(a, b).place) ? 0.02 : CollisionSurface::leastCone;
  }
  /// Throws Error where there are maximumContacts already.
  void add(Contact const& c) {
    checkRoom();
    found.push_back(c);
  }
  Contact& addNew() {
    checkRoom();
    return found.emplace_back();
  }

  /// The contacts that were found take the place of those before; no vertex of a model is touched yet, but by
  /// those of other managers.
  void manage(double dt) {
    sortFound();
    foundVertices.list(foundKeys, bodies);
    foundVertices.dropSamePlaces(found, foundKeys, bodies);
    foundVertices.dropBehindOthers(found, foundKeys, bodies);
    couplingChanged = std::exchange(couplesAgain, false);
    if (!listed) {
      keys.clear();
      for (Contact const& c : contacts) keys.push_back(c.key());
      ofVertices.list(keys, bodies);
    }
    std::size_t old = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      Contact& c = found[i];
      ContactKey const& key = foundKeys[i];
      while (old < keys.size() && keys[old] < key) ++old;
      const bool again = old < keys.size() && keys[old] == key;
      describe(c, *surfaces[std::size_t(c.a.surface)], *surfaces[std::size_t(c.b.surface)]);
      c.start = displacement(c);
      if (isThroughBody(c, key, again ? &contacts[old] : nullptr)) {
        c.response = -1;
        continue;
      }
      couplingChanged = couplingChanged || (!again && !All::isConstraint(c.response));
      const int other = again ? -1 : ofVertices.find(key, bodies);
      if (again)
        remember(c, contacts[old]);
      else if (other >= 0)
        remember(c, contacts[std::size_t(other)]);
      c.isNew = !again && other < 0 && All::isConstraint(c.response);
    }
    listed = std::erase_if(found, [](Contact const& c) { return c.response < 0; }) == 0;
    const auto joined = coupling(found);
    couplingChanged = couplingChanged || coupling(contacts) != joined;
    byForce = joined > 0;
    contacts.swap(found);
    found.clear();
    keys.swap(foundKeys);
    ofVertices.swap(foundVertices);
    All::setStep(responses, dt);
    for (Contact const& c : contacts) touch(c.a), touch(c.b);
    touchAttached();
  }

  /// The contacts of the step are to come; what is held from outside acts till then.
  void await() {
    couplingChanged = std::exchange(couplesAgain, false);
    touchAttached();
  }

  /// The contacts that were found have the same keys as those of the last step, none of them by force, and
  /// are in their places.
  void goOn(double dt) {
    couplingChanged = std::exchange(couplesAgain, false);
    All::setStep(responses, dt);
  }

  /// f(response, state, touched points of it) for the contacts of responses that change what they touch.
  template <class F>
  void forEachTouchResponse(F&& f) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (forEachTouched<I>(f), ...);
    }(std::index_sequence_for<Responses...>{});
  }

  /// Forces on the vertices of all contacts that `chosen` picks.
  template <class Chosen>
  void addForces(Chosen&& chosen) {
    for (Contact& c : contacts) {
      if (!chosen(c)) continue;
      auto& a = *surfaces[std::size_t(c.a.surface)];
      auto& b = *surfaces[std::size_t(c.b.surface)];
      All::visit(responses, c.response, [&](auto const& law) {
        if constexpr (requires { law.evaluate(c, c.start, c.start); })
          law.evaluate(
              c, displacement(c), rate_of(c.b, b, b.velocity, b.spin) - rate_of(c.a, a, a.velocity, a.spin));
      });
      add_force(c.b, b, c.evaluated);
      add_force(c.a, a, -c.evaluated);
    }
    for (Attachment& a : attachments) {
      if (!chosen(a.contact)) continue;
      auto& s = *surfaces[std::size_t(a.contact.b.surface)];
      a.evaluate(s);
      add_force(a.contact.b, s, a.contact.evaluated);
    }
  }
  /// The same for the change of the forces, k K dx + b B dx; what no solver moves stays where it is.
  template <class Chosen>
  void addDForces(double k, double b, Chosen&& chosen) const {
    for (Contact const& c : contacts) {
      if (!chosen(c)) continue;
      const Eigen::Vector3d df = change(c, k, b);
      add_force(c.b, *surfaces[std::size_t(c.b.surface)], df);
      add_force(c.a, *surfaces[std::size_t(c.a.surface)], -df);
    }
    for (Attachment const& a : attachments)
      if (chosen(a.contact))
        add_force(a.contact.b, *surfaces[std::size_t(a.contact.b.surface)], change(a, k, b));
  }

  /// f(response, contact) for the contacts that multipliers answer.
  template <class F>
  void forEachConstrained(F&& f) {
    if constexpr ((ContactConstraint<Responses> || ...))
      for (Contact& c : contacts)
        All::visit(responses, c.response, [&](auto const& r) {
          if constexpr (ContactConstraint<std::decay_t<decltype(r)>>) f(r, c);
        });
  }

  /// f(contact) for the contacts that `chosen` picks, and for those of attachments.
  template <class Chosen, class F>
  void forEachChosen(Chosen&& chosen, F&& f) {
    for (Contact& c : contacts)
      if (chosen(c)) f(c);
    for (Attachment& a : attachments)
      if (chosen(a.contact)) f(a.contact);
  }
  /// What acted over the step gets the change of the forces, k K dx + b B dx.
  template <class Chosen>
  void addActed(double k, double b, Chosen&& chosen) {
    for (Contact& c : contacts)
      if (chosen(c)) c.force += change(c, k, b);
    for (Attachment& a : attachments)
      if (chosen(a.contact)) a.contact.force += change(a, k, b);
  }
  /// The blocks of those contacts in the matrix of a solver, after its models have given their vertices to
  /// `assembly`.
  template <AssemblyPhase Phase, class Matrix, class Chosen>
  void assemble(Matrix& matrix, double k, double b, Chosen&& chosen) {
    assembly.sort();
    for (Contact const& c : contacts)
      if (chosen(c)) assembly.add<Phase>(matrix, c, surfaces, k, b);
    for (Attachment const& a : attachments)
      if (chosen(a.contact)) assembly.add<Phase>(matrix, a.contact, surfaces, k, b);
  }

 private:
  void touch(ContactSide const& side) {
    for (int k = 0; k < side.corners(); ++k)
      surfaces[std::size_t(side.surface)]->touch(side.vertices[std::size_t(k)]);
  }
  void touchAttached() {
    for (Attachment& a : attachments) {
      touch(a.contact.b);
      find_solver(a.contact, nullptr, surfaces[std::size_t(a.contact.b.surface)]);
    }
  }
  void checkRoom() {
    if (found.size() == found.capacity()) ++grown;
    if (found.size() < std::size_t(maximumContacts)) return;
    const auto all = std::exchange(found, {});
    refuse_contacts(text(path, ": ", component_name<ContactManager>()), maximumContacts, all, surfaces);
  }
  // rising by key, each key once: the same vertices meet in several pairs of primitives
  void sortFound() {
    order.clear();
    for (std::size_t i = 0; i < found.size(); ++i) order.emplace_back(found[i].key(), int(i));
    auto at = [this](auto const& entry) -> Contact const& { return found[std::size_t(entry.second)]; };
    std::sort(order.begin(), order.end(), [&](auto const& x, auto const& y) {
      if (x.first != y.first) return x.first < y.first;
      Contact const &a = at(x), &b = at(y);
      if (a.distance != b.distance) return a.distance < b.distance;
      return std::pair(a.a.element, a.b.element) < std::pair(b.a.element, b.b.element);
    });
    order.erase(
        std::unique(
            order.begin(), order.end(), [](auto const& x, auto const& y) { return x.first == y.first; }),
        order.end());
    sorted.clear();
    foundKeys.clear();
    for (auto const& entry : order) {
      sorted.push_back(at(entry));
      foundKeys.push_back(entry.first);
    }
    found.swap(sorted);
  }
  // how many of them may join vertices in the matrix of a solver
  static auto coupling(std::vector<Contact> const& all) {
    return std::count_if(
        all.begin(), all.end(), [](Contact const& c) { return !All::isConstraint(c.response); });
  }
  bool fits(ContactSide const& side) const {
    if (side.surface < 0 || side.surface >= int(surfaces.size())) return false;
    auto const& s = *surfaces[std::size_t(side.surface)];
    bool all = side.vertices[0] >= 0;
    for (const int v : side.vertices) all = all && v < int(s.position.size());
    return all;
  }
  Eigen::Vector3d displacement(Contact const& c) const {
    return position_of(c.b, *surfaces[std::size_t(c.b.surface)]) -
           position_of(c.a, *surfaces[std::size_t(c.a.surface)]);
  }
  // Whether what is between the two places of a body, one of them behind a triangle, is the body itself: so
  // it is unless the same contact, or another one of its vertex, was on that side in the last step, for
  // nothing gets behind a triangle from outside without having been near its front. `before` is the same one.
  bool isThroughBody(Contact const& c, ContactKey const& key, Contact const* before) const {
    if (bodies[std::size_t(c.a.surface)] != bodies[std::size_t(c.b.surface)]) return false;
    auto isOfFace = [&](ContactSide const& side) {
      return is_of_one_sided_face(side, *surfaces[std::size_t(side.surface)]);
    };
    // (where an edge crosses a triangle, the two places are one, to rounding)
    const double rounding =
        1e-12 * surfaces[std::size_t(c.b.surface)]->position[std::size_t(c.b.vertices[0])].norm();
    if ((!isOfFace(c.a) && !isOfFace(c.b)) || c.normal.dot(c.start) > rounding) return false;
    auto goesOn = [&c](Contact const& last) { return last.normal.dot(c.normal) > 0; };
    if (before && goesOn(*before)) return false;
    return ofVertices.find(key, bodies, [&](int i) { return goesOn(contacts[std::size_t(i)]); }) < 0;
  }
  // of the force, where the vertices go by dx; what the solver does not move stays where it is
  Eigen::Vector3d change(Contact const& c, double k, double b) const {
    auto const& first = *surfaces[std::size_t(c.a.surface)];
    auto const& second = *surfaces[std::size_t(c.b.surface)];
    Eigen::Vector3d du(0, 0, 0);
    if (second.solver == c.solver && second.settings.simulated)
      du += rate_of(c.b, second, second.dx, second.angularDx);
    if (first.solver == c.solver && first.settings.simulated)
      du -= rate_of(c.a, first, first.dx, first.angularDx);
    return -(k * (c.stiffnessMatrix * du) + b * (c.dampingMatrix * du));
  }
  Eigen::Vector3d change(Attachment const& a, double k, double b) const {
    auto const& s = *surfaces[std::size_t(a.contact.b.surface)];
    const Eigen::Vector3d du = rate_of(a.contact.b, s, s.dx, s.angularDx);
    return -(k * a.stiffness + b * a.damping) * du;
  }
  template <std::size_t R, class F>
  void forEachTouched(F& f) {
    using Response = std::tuple_element_t<R, std::tuple<Responses...>>;
    if constexpr (!ContactLaw<Response> && !ContactConstraint<Response>)
      for (std::size_t s = 0; s < surfaces.size(); ++s) {
        points.clear();
        for (Contact const& c : contacts)
          if (c.response == int(R) && c.distance < c.limit)
            for (ContactSide const* side : {&c.a, &c.b})
              if (side->surface == int(s))
                for (int k = 0; k < side->corners(); ++k) points.push_back(side->vertices[std::size_t(k)]);
        if (points.empty()) continue;
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        f(std::get<R>(responses), surfaces[s]->state, std::span<int const>(points));
      }
  }
  void describe(Contact& c, CollisionSurface const& a, CollisionSurface const& b) const {
    const double reach = c.limit + a.radiusOf(c.a.element) + b.radiusOf(c.b.element);
    CollisionSettings const &ofA = a.settings, &ofB = b.settings;
    c.stiffness = ofA.contactStiffness * ofB.contactStiffness / (reach > 0 ? reach : 1);
    c.damping = ofA.contactDamping + ofB.contactDamping;
    c.fall = std::max({0.0, c.normal.dot(a.gravity), -c.normal.dot(b.gravity)});
    const ResponseChoice chosen = answers.find(c.a.surface, c.b.surface);
    c.response = chosen.place;
    if (c.response < 0) return;
    c.friction = frictionOf(chosen, a, b);
    find_solver(c, &a, &b);
    if (!All::isForce(c.response)) c.solver = -1, c.loose = false;
  }
  static void remember(Contact& c, Contact const& old) {
    c.frictionState = old.frictionState;
    c.pushed = old.pushed;
    c.force = old.force;
  }
};

/// What scene files have.
using DefaultContactManager = ContactManager<PenalityContactForceField, StickContactForceField,
                                             FrictionContactConstraint, StickContactConstraint>;

}  // namespace sinew
