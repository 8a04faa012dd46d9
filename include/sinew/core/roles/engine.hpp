// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <string>

namespace sinew {

// Makes data of other components, before the scene starts and when what it follows changes: loaders,
// selections. The shortest:
//
//   /// The numbers from 0 on.
//   struct FirstNumbers {
//     using Role = role::Engine;
//     static constexpr std::string_view className = "FirstNumbers";
//
//     int count = 1;
//     std::vector<int> indices{};
//
//     static constexpr auto fields() {
//       return field_list(field("count", &FirstNumbers::count, "", "how many", range::nonNegative));
//     }
//     static constexpr auto outputs() {
//       return field_list(field("indices", &FirstNumbers::indices, "", "the numbers"));
//     }
//     void update(std::string_view) {
//       indices.clear();
//       for (int i = 0; i < count; ++i) indices.push_back(i);
//     }
//   };

template <class C>
concept HasOutputs = requires { C::outputs(); };
template <class C>
concept HasUpdate = requires(C c, std::string where) { c.update(where); };

/// Files to read and points to select, turned into data of other components: update(where) makes what
/// outputs() lists, as fields() does, from the fields alone, as often as these change. Where it throws, the
/// outputs stay.
template <class C>
concept Engine = HasRole<C, role::Engine> && HasOutputs<C> && HasUpdate<C>;

template <>
struct Promise<role::Engine> : NoPromise {
  template <class C>
  static constexpr bool kept = Engine<C>;
  template <class C>
  struct Broken {
    static_assert(HasOutputs<C>,
                  "Sinew: an engine has no 'static constexpr auto outputs()', which lists what it makes, as "
                  "fields() does.");
    static_assert(HasUpdate<C>,
                  "Sinew: an engine has no 'void update(std::string_view where)', which makes its outputs.");
  };
};

}  // namespace sinew
