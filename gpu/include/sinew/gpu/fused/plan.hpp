// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/device_vector.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sinew::gpu {

/// How the rows of a body's system are shared out among the blocks of a cluster. Rows are put in the reverse
/// order of Cuthill and McKee (1969) and cut into as many stretches as there are blocks, so that few of a
/// block's rows have neighbours in other blocks. What a block needs of the others, its border, follows its
/// own rows in its vectors; the owner of a value sends it there.
struct FusedPlan {
  static constexpr int maxRows = 4095;  // of a block, with its border

  int ranks = 0, rows = 0;
  int widest = 0, longestVector = 0;         // over the blocks: rows, rows with border
  std::vector<int> order{};                  // node of each row
  std::vector<int> rowBegin{};               // first row of each rank
  std::vector<int> entryFirst{};             // of each row; its first entry is the diagonal
  std::vector<int> entryRow{}, entryNode{};  // of each entry: its row's node, and its column's
  std::vector<int> columnRow{};              // of each entry: row of its column,
  std::vector<std::uint16_t> column{};       // and its place in the vectors of the rank
  std::vector<int> sendFirst{};              // of each row
  std::vector<unsigned> sends{};             // rank << 16 | place in the vectors of that rank
  std::vector<int> nearFirst{}, near{};      // of each rank: those that have rows of its border

  /// neighbours[i]: the nodes with which node i shares an element, in rising order, itself left out.
  FusedPlan(std::vector<std::vector<int>> const& neighbours, int blocks) : ranks(blocks) {
    rows = int(neighbours.size());
    orderRows(neighbours);
    std::vector<int> rowOf(order.size());
    for (int r = 0; r < rows; ++r) rowOf[std::size_t(order[std::size_t(r)])] = r;

    // stretches of alike length
    for (int rank = 0; rank <= ranks; ++rank) rowBegin.push_back(int(long(rows) * rank / ranks));
    entryFirst.assign(1, 0);
    for (const int node : order) {
      std::vector<int> columns;
      for (const int other : neighbours[std::size_t(node)]) columns.push_back(rowOf[std::size_t(other)]);
      std::sort(columns.begin(), columns.end());
      columns.insert(columns.begin(), rowOf[std::size_t(node)]);
      for (const int c : columns) {
        entryRow.push_back(node);
        entryNode.push_back(order[std::size_t(c)]);
        columnRow.push_back(c);
      }
      entryFirst.push_back(int(columnRow.size()));
    }

    // borders
    nearFirst.assign(1, 0);
    column.resize(entryNode.size());
    std::vector<std::vector<unsigned>> sendsOf(order.size());
    for (int rank = 0; rank < ranks; ++rank) {
      const int begin = rowBegin[std::size_t(rank)], end = rowBegin[std::size_t(rank) + 1];
      std::vector<int> border;
      for (int e = entryFirst[std::size_t(begin)]; e < entryFirst[std::size_t(end)]; ++e) {
        const int row = columnRow[std::size_t(e)];
        if (row < begin || row >= end) border.push_back(row);
      }
      std::sort(border.begin(), border.end());
      border.erase(std::unique(border.begin(), border.end()), border.end());
      for (int e = entryFirst[std::size_t(begin)]; e < entryFirst[std::size_t(end)]; ++e) {
        const int row = columnRow[std::size_t(e)];
        const auto place =
            row >= begin && row < end
                ? row - begin
                : end - begin + int(std::lower_bound(border.begin(), border.end(), row) - border.begin());
        column[std::size_t(e)] = std::uint16_t(place);
      }
      for (const int row : border) {
        const int other = int(std::upper_bound(rowBegin.begin(), rowBegin.end(), row) - rowBegin.begin()) - 1;
        if (near.size() == std::size_t(nearFirst.back()) || near.back() != other) near.push_back(other);
      }
      nearFirst.push_back(int(near.size()));
      for (std::size_t b = 0; b < border.size(); ++b)
        sendsOf[std::size_t(border[b])].push_back(unsigned(rank) << 16 | unsigned(end - begin + int(b)));
      widest = std::max(widest, end - begin);
      longestVector = std::max(longestVector, end - begin + int(border.size()));
    }
    sendFirst.assign(1, 0);
    for (auto const& list : sendsOf) {
      sends.insert(sends.end(), list.begin(), list.end());
      sendFirst.push_back(int(sends.size()));
    }
  }

  /// Where the entries of each row begin that stand in the shared memory of its rank, when so many of each
  /// are kept elsewhere; and the largest number of them in a rank.
  struct Shared {
    std::vector<int> first{};
    int maximum = 0;
  };
  Shared shared(int kept) const {
    Shared all;
    for (std::size_t rank = 0; rank + 1 < rowBegin.size(); ++rank) {
      int place = 0;
      for (int row = rowBegin[rank]; row < rowBegin[rank + 1]; ++row) {
        all.first.push_back(place);
        place += std::max(0, entryFirst[std::size_t(row) + 1] - entryFirst[std::size_t(row)] - kept);
      }
      all.maximum = std::max(all.maximum, place);
    }
    return all;
  }

  bool possible() const { return longestVector <= maxRows; }

 private:
  void orderRows(std::vector<std::vector<int>> const& neighbours) {
    const std::size_t n = neighbours.size();
    std::vector<bool> seen(n, false);
    auto degree = [&](int i) { return neighbours[std::size_t(i)].size(); };
    // nodes in layers around `start`; returns the last one
    auto spread = [&](int start, std::vector<bool>& taken, std::vector<int>* into) {
      std::vector<int> wave{start};
      taken[std::size_t(start)] = true;
      for (std::size_t k = 0; k < wave.size(); ++k) {
        std::vector<int> next;
        for (const int j : neighbours[std::size_t(wave[k])])
          if (!taken[std::size_t(j)]) {
            taken[std::size_t(j)] = true;
            next.push_back(j);
          }
        std::sort(next.begin(), next.end(), [&](int a, int b) {
          return degree(a) != degree(b) ? degree(a) < degree(b) : a < b;
        });
        wave.insert(wave.end(), next.begin(), next.end());
      }
      if (into) into->insert(into->end(), wave.begin(), wave.end());
      return wave.back();
    };
    for (std::size_t i = 0; i < n; ++i)
      if (!seen[i]) {
        // from one end of the body: the farthest from the farthest
        std::vector<bool> a = seen, b = seen;
        const int start = spread(spread(int(i), a, nullptr), b, nullptr);
        spread(start, seen, &order);
      }
    std::reverse(order.begin(), order.end());
  }
};

}  // namespace sinew::gpu
