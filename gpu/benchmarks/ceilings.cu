// SPDX-License-Identifier: BSL-1.0
// What the GPU does at best, for the shares that scenes prints and for what limits small bodies: bandwidth of
// copies of many sizes, the rate of arithmetic, and what a launch and an exchange between blocks take.
#include "ceilings.hpp"

#include <cstdio>

using namespace bench;

int main() try {
  for (const double megabytes : {0.25, 1., 4., 16., 64., 128., 256., 1024., 4096.})
    std::printf("copy; %.2f MB read and written; %.0f GB/s\n",
                megabytes,
                copy_bandwidth(std::size_t(megabytes * 1e6)) / 1e9);
  std::printf("multiply and add; float; %.1f Tflop/s\n", peak<float>() / 1e12);
  std::printf("multiply and add; double; %.1f Tflop/s\n", peak<double>() / 1e12);
  std::printf("a launch; by the host; %.2f us\n", launch_seconds() * 1e6);
  std::printf("a launch; in a graph; %.2f us\n", node_seconds() * 1e6);
  for (const int blocks : {2, 4, 8, 16})
    std::printf("an exchange; a cluster of %d; %.2f us\n", blocks, exchange_seconds(blocks, true) * 1e6);
  for (const int blocks : {33, 66, 132})
    std::printf(
        "an exchange; %d blocks of a launch; %.2f us\n", blocks, exchange_seconds(blocks, false) * 1e6);
  return 0;
} catch (std::exception const& error) {
  std::fprintf(stderr, "ceilings: %s\n", error.what());
  return 1;
}
