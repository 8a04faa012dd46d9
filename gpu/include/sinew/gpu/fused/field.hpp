// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/assembled_system.hpp>
#include <sinew/gpu/fused/plan.hpp>
#include <sinew/gpu/fused/step.hpp>
#include <sinew/gpu/gpu.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace sinew::gpu {

namespace detail {

template <class Driver>
struct FusedOf;
template <template <class> class LawOf, class D, int W>
struct FusedOf<ElementDriver<LawOf, D, W>> {
  using Elements = FusedElements<LawOf, D>;
};

}  // namespace detail

/// The elements of one force field of a fused step, and what its copies have of them on the device.
template <class Field>
struct FusedField {
  using Deriv = typename Field::DataTypes::Deriv;
  using Elements = typename detail::FusedOf<typename Field::Driver>::Elements;
  using Law = typename Elements::Law;
  static constexpr int arity = Elements::arity;
  Law law{};
  std::vector<std::array<int, arity>> elements{};
  int nodes = 0;
  DeviceVector<int> index{}, partFirst{}, partEntry{}, entryFirst{}, entryCode{};
  DeviceArray<typename Law::Rest> rest{};
  DeviceArray<typename Law::Tangent> tangent{};
  DeviceArray<Deriv> part{};

  void init(Field const& field, FusedPlan const& plan, int copies) {
    law = law_of(field);
    elements = field.driver.elements;
    nodes = int(field.driver.nodes);
    index = field.driver.index;
    const std::size_t all = elements.size() * std::size_t(copies);
    rest.resize(all);
    if constexpr (!Elements::byRows) {
      partFirst = field.driver.around.first;
      partEntry = field.driver.around.entry;
      tangent.resize(all);
      part.resize(all * arity);
    }

    // the entry of the matrix for two nodes
    std::vector<std::vector<std::pair<int, int>>> ofNode(std::size_t(plan.rows));
    for (std::size_t e = 0; e < plan.entryNode.size(); ++e)
      ofNode[std::size_t(plan.entryRow[e])].push_back({plan.entryNode[e], int(e)});
    for (auto& list : ofNode) std::sort(list.begin(), list.end());
    auto entry = [&](int a, int b) {
      auto const& list = ofNode[std::size_t(a)];
      return std::size_t(std::lower_bound(list.begin(), list.end(), std::pair{b, 0})->second);
    };
    std::vector<std::vector<int>> codes(plan.entryNode.size());
    for (std::size_t e = 0; e < elements.size(); ++e) {
      int pair = 0;
      for (std::size_t i = 0; i < arity; ++i)
        for (std::size_t j = i; j < arity; ++j, ++pair) {
          if (i == j && arity > 1) continue;
          const int code = (int(e) * detail::BlockOfElement<arity>::pairs + pair) * 2;
          codes[entry(elements[e][i], elements[e][j])].push_back(code);
          if (i != j) codes[entry(elements[e][j], elements[e][i])].push_back(code + 1);
        }
    }
    std::vector<int> first{0}, flat;
    for (auto const& list : codes) {
      flat.insert(flat.end(), list.begin(), list.end());
      first.push_back(int(flat.size()));
    }
    entryFirst = std::move(first);
    entryCode = std::move(flat);
  }
  void load(int copy, Field const& from) {
    if (from.driver.elements != elements)
      throw Error("FusedSimulation::load",
                  text(component_name<Field>(),
                       " has other elements than that of the copies; load a simulation of the same scene"));
    copy_on_device(
        rest.data() + std::size_t(copy) * elements.size(), from.driver.rest.device(), elements.size());
  }
  Elements view() {
    return {law,
            int(elements.size()),
            index.device(),
            rest.data(),
            tangent.data(),
            part.data(),
            nodes,
            partFirst.device(),
            partEntry.device(),
            entryFirst.device(),
            entryCode.device()};
  }
};

}  // namespace sinew::gpu
