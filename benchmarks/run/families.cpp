// SPDX-License-Identifier: BSL-1.0
// Time of each family of components an element [ns], in double and float, with as many elements at a time as
// the processor has lanes and one by one, on a body of 1,331 points that fits into the caches. The four take
// turns; the figures are medians over the rounds. Prints lines of: family; operation; count; the four
// figures, "-" where a family has no lanes.
#include "families.hpp"

#include "paired.hpp"

#include <cstdlib>

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 11;
  if (rounds < 1) {
    std::fprintf(stderr, "usage: families [ROUNDS]\n");
    return 2;
  }
  const std::vector<bench::Work> kinds[] = {
      bench::in_double(), bench::in_double_one_by_one(), bench::in_float(), bench::in_float_one_by_one()};
  for (std::size_t w = 0; w < kinds[0].size(); ++w) {
    std::vector<double> times[4];
    int repeats[4] = {};
    for (int r = -1; r < rounds; ++r)
      for (std::size_t k = 0; k < 4; ++k) {
        if (w >= kinds[k].size()) continue;
        auto const& work = kinds[k][w];
        // of about 2 ms, after a first run that warms up
        if (r < 0) {
          work.run();
          repeats[k] = 1 + int(0.002 / bench::processor_seconds(work.run));
          continue;
        }
        const double time = bench::processor_seconds([&] {
          for (int i = 0; i < repeats[k]; ++i) work.run();
        });
        times[k].push_back(1e9 * time / repeats[k] / double(work.count));
      }
    auto const& work = kinds[0][w];
    std::printf("%s; %s; %zu", work.family.c_str(), work.operation.c_str(), work.count);
    for (auto const& t : times)
      if (t.empty())
        std::printf("; -");
      else
        std::printf("; %.3f", bench::median(t));
    std::printf("\n");
    std::fflush(stdout);
  }
}
