// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/control/triple_buffer.hpp>

#include <atomic>
#include <thread>

namespace test_triple_buffer {

using namespace sinew;

namespace {

// larger than a cache line: a torn read would mix two values
struct Wide {
  long words[40];
  explicit Wide(long value = 0) { fill(value); }
  void fill(long value) {
    for (int i = 0; i < 40; ++i) words[i] = value * (i + 1);
  }
  bool whole() const {
    for (int i = 0; i < 40; ++i)
      if (words[i] != words[0] * (i + 1)) return false;
    return true;
  }
};

}  // namespace

TEST_CASE("a triple buffer has its initial value, then the latest that was written, once") {
  TripleBuffer<int> buffer(7);
  CHECK(buffer.read() == 7);
  CHECK(!buffer.update());
  CHECK(buffer.read() == 7);
  buffer.write(1);
  CHECK(buffer.read() == 7);  // until it is taken
  CHECK(buffer.update());
  CHECK(buffer.read() == 1);
  CHECK(!buffer.update());
  for (int i = 2; i < 100; ++i) buffer.write(i);
  CHECK(buffer.update());
  CHECK(buffer.read() == 99);
  CHECK(!buffer.update());
  // every order of writes and reads
  for (unsigned order = 0; order < 1u << 12; ++order) {
    TripleBuffer<int> b(0);
    int written = 0, taken = 0;
    for (int i = 0; i < 12; ++i)
      if (order >> i & 1) {
        b.write(++written);
      } else {
        REQUIRE(b.update() == (written > taken));
        taken = written;
        REQUIRE(b.read() == written);
      }
  }
}

TEST_CASE("two threads exchange millions of values: none is torn, none goes back, the last arrives") {
  const long values = 2'000'000;
  TripleBuffer<Wide> buffer;
  std::atomic<bool> torn{false}, back{false};
  long updates = 0, last = 0;
  std::thread reader([&] {
    while (last < values) {
      if (!buffer.update()) continue;
      Wide const& w = buffer.read();
      ++updates;
      if (!w.whole()) torn = true;
      if (w.words[0] <= last) back = true;
      last = w.words[0];
      if (torn || back) return;
    }
  });
  Wide w;
  for (long i = 1; i <= values; ++i) {
    w.fill(i);
    buffer.write(w);
  }
  reader.join();
  CHECK(!torn);
  CHECK(!back);
  CHECK(last == values);
  CHECK(updates > 0);
  CHECK(updates <= values);
}

TEST_CASE("two buffers carry a conversation: each side has what the other said") {
  // each answers the number that it heard with the next, so that all of them pass both ways
  TripleBuffer<Wide> there, back;
  const long turns = 20'000;
  bool whole = true;
  std::thread other([&] {
    for (long heard = 0; heard < turns;) {
      if (!there.update()) {
        std::this_thread::yield();
        continue;
      }
      whole = whole && there.read().whole();
      heard = there.read().words[0];
      back.write(Wide(heard));
    }
  });
  bool same = true;
  for (long i = 1; i <= turns; ++i) {
    there.write(Wide(i));
    while (!back.update()) std::this_thread::yield();
    same = same && back.read().words[0] == i && back.read().whole();
  }
  other.join();
  CHECK(whole);
  CHECK(same);
}

}  // namespace test_triple_buffer
