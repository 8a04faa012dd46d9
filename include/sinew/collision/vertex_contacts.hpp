// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/compiled.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace sinew {

/// Whether two contacts of a vertex, by their displacements p_b - p_a, are at the same place: its rounding is
/// a few units of the last digit of coordinates.
SINEW_HD inline bool is_same_place(Eigen::Vector3d const& first, Eigen::Vector3d const& other) {
  return (other - first).norm() <= 1e-8 * first.norm();
}
/// Whether a vertex is behind what it meets in a contact C.
template <class C>
SINEW_HD bool is_behind(C const& c) {
  return c.normal.dot(c.start) < 0;
}
/// Whether of two contacts of a vertex one is behind, and the other in front and nearer in its direction.
template <class C>
SINEW_HD bool is_behind_other(C const& far, C const& near) {
  return is_behind(far) && !is_behind(near) && near.start.squaredNorm() < far.start.squaredNorm() &&
         near.start.dot(far.start) > 0;
}

/// The contacts of single vertices, or corners of hulls, among some contacts. A vertex that slides from one
/// triangle to the next, or from that to an edge, goes on with the same contact.
class VertexContacts {
 public:
  void reserve(std::size_t contacts) { list_.reserve(2 * contacts); }
  void swap(VertexContacts& other) { list_.swap(other.list_); }

  /// `bodies`: of each surface, the first one that is on the same state.
  void list(std::vector<ContactKey> const& keys, std::vector<int> const& bodies);

  /// The number of the first contact that has a vertex of this one for itself, and for which
  /// accepts(number); -1: there is none.
  template <class Accepts>
  int find(ContactKey const& key, std::vector<int> const& bodies, Accepts&& accepts) const {
    for (std::size_t side = 0; side < 2; ++side) {
      if (!key.ofOneVertex(side)) continue;
      const Identity wanted = identity(key, side, bodies);
      auto at = std::lower_bound(
          list_.begin(), list_.end(), wanted, [](Entry const& x, Identity const& k) { return x.vertex < k; });
      for (; at != list_.end() && at->vertex == wanted; ++at)
        if (accepts(at->contact)) return at->contact;
    }
    return -1;
  }
  int find(ContactKey const& key, std::vector<int> const& bodies) const {
    return find(key, bodies, [](int) { return true; });
  }

  /// A vertex above the border of two triangles is near the one, and near the edge of the other, at the same
  /// place: once is enough. The list is that of `found`, and so are the keys.
  void dropSamePlaces(std::vector<Contact>& found, std::vector<ContactKey>& keys,
                      std::vector<int> const& bodies);

  /// What is behind a triangle is in the body, and pushed out, unless it is in front of something of the same
  /// body that is nearer in that direction: then it is above a plate, whose far side it is behind.
  void dropBehindOthers(std::vector<Contact>& found, std::vector<ContactKey>& keys,
                        std::vector<int> const& bodies);

 private:
  // the two bodies, the side, the vertex, and the corner of its hull
  using Identity = std::array<int, 5>;
  struct Entry {
    Identity vertex;
    int contact;
  };
  std::vector<Entry> list_{};

  static Identity identity(ContactKey const& k, std::size_t side, std::vector<int> const& bodies) {
    return {bodies[std::size_t(k.surfaces[0])],
            bodies[std::size_t(k.surfaces[1])],
            int(side),
            k.vertices[side][2],
            k.features[side].first};
  }
  static constexpr int dropped = -1;  // in place of a response
  void removeDropped(std::vector<Contact>& found, std::vector<ContactKey>& keys,
                     std::vector<int> const& bodies);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <utility>

namespace sinew {

SINEW_ONCE void VertexContacts::list(std::vector<ContactKey> const& keys, std::vector<int> const& bodies) {
  list_.clear();
  for (std::size_t i = 0; i < keys.size(); ++i)
    for (std::size_t side = 0; side < 2; ++side)
      if (keys[i].ofOneVertex(side)) list_.push_back({identity(keys[i], side, bodies), int(i)});
  std::sort(list_.begin(), list_.end(), [](Entry const& x, Entry const& y) {
    return std::pair(x.vertex, x.contact) < std::pair(y.vertex, y.contact);
  });
}

SINEW_ONCE void VertexContacts::dropSamePlaces(std::vector<Contact>& found, std::vector<ContactKey>& keys,
                                               std::vector<int> const& bodies) {
  bool any = false;
  for (std::size_t i = 0, j = 1; j < list_.size(); ++j) {
    if (list_[i].vertex != list_[j].vertex) {
      i = j;
      continue;
    }
    Contact const& first = found[std::size_t(list_[i].contact)];
    Contact& other = found[std::size_t(list_[j].contact)];
    if (!is_same_place(first.start, other.start)) continue;
    other.response = dropped;
    any = true;
  }
  if (any) removeDropped(found, keys, bodies);
}

SINEW_ONCE void VertexContacts::dropBehindOthers(std::vector<Contact>& found, std::vector<ContactKey>& keys,
                                                 std::vector<int> const& bodies) {
  bool any = false;
  for (std::size_t first = 0, last = 0; first < list_.size(); first = last) {
    while (last < list_.size() && list_[last].vertex == list_[first].vertex) ++last;
    auto contact = [&](std::size_t i) -> Contact& { return found[std::size_t(list_[i].contact)]; };
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t j = first; j < last && is_behind(contact(i)); ++j) {
        if (!is_behind_other(contact(i), contact(j))) continue;
        contact(i).response = dropped;
        any = true;
      }
  }
  if (any) removeDropped(found, keys, bodies);
}

SINEW_ONCE void VertexContacts::removeDropped(std::vector<Contact>& found, std::vector<ContactKey>& keys,
                                              std::vector<int> const& bodies) {
  std::size_t left = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].response == dropped) continue;
    if (left != i) {
      found[left] = found[i];
      keys[left] = keys[i];
    }
    ++left;
  }
  found.resize(left);
  keys.resize(left);
  list(keys, bodies);
}

}  // namespace sinew
#endif
