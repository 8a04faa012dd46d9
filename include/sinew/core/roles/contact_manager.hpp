// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <string>
#include <vector>

namespace sinew {

// Keeps contacts from step to step, and answers them. ContactManager (collision/contact_manager.hpp) is the
// one that there is; what is written for it is a response, a law of contact (CONTRIBUTING.md shows one).

struct CollisionSurface;  // the primitives of a model: collision/collision_surface.hpp
struct Contact;           // collision/contact.hpp

/// The contacts of a step, those between bodies and those by which a place is held from outside.
template <class C>
concept HasContacts = requires(C const c) {
  c.contacts.size();
  c.attachments.size();
  { c.acts() } -> std::convertible_to<bool>;
};
/// After all models; `again`: in the middle of the simulation.
template <class C>
concept HasInitOfModels =
    requires(C c, std::string const& where, std::vector<CollisionSurface*> const& models, bool again) {
      c.init(where, models, again);
    };
/// At the start of a step: takeModels, with the models of the scene, of which a copy has its own; settle,
/// where these are as the last step left them; add, for each contact that is found; manage, which answers
/// them. `couplingChanged` says whether other vertices meet than before.
template <class C>
concept TakesContacts =
    requires(C c, std::vector<CollisionSurface*> const& models, Contact const& contact, double dt) {
      c.takeModels(models);
      c.settle();
      c.add(contact);
      c.manage(dt);
      { c.couplingChanged } -> std::convertible_to<bool>;
    };

template <class C>
concept ManagesContacts =
    HasRole<C, role::ContactManager> && HasContacts<C> && HasInitOfModels<C> && TakesContacts<C> &&
    may_have<C>(named::addForces<C>) && may_have<C>(named::addDForces<C>);

template <>
struct Promise<role::ContactManager> : NoPromise {
  template <class C>
  static constexpr bool kept = ManagesContacts<C>;
  template <class C>
  struct Broken {
    static constexpr bool takes = TakesContacts<C>;  // compilers explain a concept at length
    static_assert(HasContacts<C>,
                  "Sinew: a contact manager has no 'contacts', no 'attachments' or no 'bool acts() const', "
                  "whether there are any; take ContactManager<MyResponse>, which has them.");
    static_assert(HasInitOfModels<C>,
                  "Sinew: a contact manager has no 'void init(std::string const& where, "
                  "std::vector<CollisionSurface*> const& models, bool again)'; take "
                  "ContactManager<MyResponse>, which has it.");
    static_assert(takes,
                  "Sinew: a contact manager has no 'void takeModels(std::vector<CollisionSurface*> "
                  "const& models)', 'void settle()', 'void add(Contact const& contact)', 'void manage(double "
                  "dt)' or 'bool couplingChanged'; take ContactManager<MyResponse>, which has them.");
    static_assert(may_have<C>(named::addForces<C>) && may_have<C>(named::addDForces<C>),
                  "Sinew: a contact manager has no addForces or no addDForces, the forces of its contacts "
                  "and their change; take ContactManager<MyResponse>, which has them.");
  };
};

}  // namespace sinew
