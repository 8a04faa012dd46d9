// SPDX-License-Identifier: BSL-1.0
#include "linear_system.hpp"
#include "paired.hpp"

#include <sinew/solver/cholmod_solver.hpp>

namespace bench {

LinearResult solve_by_cholmod(LinearSystem const& s) {
  LinearResult result;
  std::vector<int> starts{0}, rows;
  std::vector<double> values, b = s.rhs;
  for (int i = 0; i < s.unknowns; ++i) {
    for (int k = s.starts[std::size_t(i)]; k < s.starts[std::size_t(i) + 1]; ++k)
      if (s.columns[std::size_t(k)] >= i) {
        rows.push_back(s.columns[std::size_t(k)]);
        values.push_back(s.values[std::size_t(k)]);
      }
    starts.push_back(int(rows.size()));
  }
  result.x.resize(b.size());
  sinew::CholmodFactor factor;
  factor.analyse("CHOLMOD", starts, rows, values);  // once for a pattern, as aggregates are
  result.setUp = processor_seconds([&] { factor.factorise(); });
  result.solve = processor_seconds([&] { factor.solve(b, result.x); });
  result.iterations = 1;
  return result;
}

}  // namespace bench
