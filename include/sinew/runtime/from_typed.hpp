// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scope.hpp>

#include <boost/hana/zip.hpp>

namespace sinew {

namespace detail {

template <class R, class C>
void add_typed(RuntimeNode<R>& to, C const& component) {
  if constexpr (requires { C::Ends::first; }) {
    // the ends of an interaction become paths found at run time
    typename C::template WithEnds<Linked> joint;
    boost::hana::for_each(boost::hana::zip(C::fields(), decltype(joint)::fields()), [&](auto const& pair) {
      joint.*(boost::hana::at_c<1>(pair).member) = component.*(boost::hana::at_c<0>(pair).member);
    });
    joint.ends = {std::string(C::Ends::first.view()), std::string(C::Ends::second.view())};
    to.add(std::move(joint));
  } else if constexpr (requires { C::Parents::list(); }) {
    typename C::template WithParents<LinkedParents> mapping;
    boost::hana::for_each(boost::hana::zip(C::fields(), decltype(mapping)::fields()), [&](auto const& pair) {
      mapping.*(boost::hana::at_c<1>(pair).member) = component.*(boost::hana::at_c<0>(pair).member);
    });
    mapping.parents.paths = C::Parents::list();
    to.add(std::move(mapping));
  } else {
    to.add(component);
  }
}

}  // namespace detail

/// The runtime tree of the same components and nodes as a typed one: to save it as XML, say. The registry R
/// has all its classes.
template <class R, class Name, class Components, class Children>
RuntimeNode<R> to_runtime(Node<Name, Components, Children> const& typed) {
  RuntimeNode<R> node{std::string(Name::value.view())};
  hana::for_each(typed.components, [&](auto const& component) { detail::add_typed(node, component); });
  hana::for_each(typed.children, [&](auto const& child) {
    if constexpr (requires { child.children(); })
      node.addChild(RuntimeNode<R>(child));
    else
      node.addChild(to_runtime<R>(child));
  });
  return node;
}

}  // namespace sinew
