// SPDX-License-Identifier: BSL-1.0
// A step has the same bits with any number of threads.
#include "threaded_bodies.hpp"

#include <catch.hpp>

#include <atomic>
#include <thread>

namespace test_threads {

using namespace sinew;
using namespace threaded;

TEST_CASE("a corotational body has the same bits with any number of threads", "[threads]") {
  const Mesh mesh = block();
  SECTION("assembled") {
    same_bits([&](int n) { return fem<Vec3d, CompressedRowSparseMatrixMat3x3d>(mesh, n); });
  }
  SECTION("matrix-free") {
    same_bits([&](int n) { return fem<Vec3d, GraphScattered>(mesh, n); });
  }
}

TEST_CASE("a body of its own has no threads in a copy's way", "[threads]") {
  const Mesh mesh = block();
  auto sim = fem<Vec3d, GraphScattered>(mesh, 3);
  sim.init();
  sim.animate(0.01);
  auto other = sim;
  // both at once, each from a thread of its own
  std::thread beside([&] { run(other, 2); });
  run(sim, 2);
  beside.join();
  CHECK(bits(sim) == bits(other));
  auto alone = fem<Vec3d, GraphScattered>(mesh, 1);
  alone.init();
  run(alone, 3);
  CHECK(bits(alone) == bits(sim));
}

TEST_CASE("the number of threads has bounds", "[threads]") {
  for (const int count : {0, -1, 257, 1000000000}) {
    auto sim = fem<Vec3d, GraphScattered>(block(), count);
    try {
      sim.init();
      FAIL("accepted " << count);
    } catch (Error const& error) {
      const std::string words = error.what();
      CHECK(words.find("Threads") != std::string::npos);
      CHECK(words.find("count") != std::string::npos);
      CHECK(words.find("256") != std::string::npos);
    }
  }
}

TEST_CASE("what a worker throws reaches the caller, and the threads go on", "[threads]") {
  Workers workers(4);
  for (int round = 0; round < 3; ++round) {
    // of several, the one of the first share
    CHECK_THROWS_WITH(workers.run([](WorkShare share) {
      if (share.index >= 2) throw Error("part", text(share.index));
    }),
                      Catch::Matchers::Contains("2") && !Catch::Matchers::Contains("3"));
    CHECK_THROWS_AS(workers.run([](WorkShare share) {
      if (share.index == 0) throw Error("part", "0");
    }),
                    Error);
    std::atomic<int> sum{0};
    workers.run([&](WorkShare share) { sum += share.index + 1; });
    CHECK(sum == 10);
  }
}

TEST_CASE("shares cover a whole once", "[threads]") {
  for (const std::size_t n : {0u, 1u, 7u, 100u})
    for (const int count : {1, 2, 3, 8, 64}) {
      std::size_t next = 0;
      for (int k = 0; k < count; ++k) {
        const WorkShare share{k, count};
        CHECK(share.begin(n) == next);
        next = share.end(n);
      }
      CHECK(next == n);
    }
}

}  // namespace test_threads
