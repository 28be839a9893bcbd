// SPDX-License-Identifier: GPL-3.0-or-later
// geometry/gap_batch.hpp: the stack that a batch call needs in each thread. Of builds that are
// optimised and not instrumented.
#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/overlap_batch.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Family;
using testing::Indexed;

constexpr std::size_t kPromised = 128 << 10, kPromisedOfPlainPairs = 160 << 10;
constexpr std::size_t kRoom = 1 << 20;
constexpr unsigned char kPaint = 0xa5;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
constexpr bool kMeasured = false;
#else
constexpr bool kMeasured = true;
#endif

/// The stack that `work` takes in a thread of its own, with what the system puts there.
std::size_t stack_of(const std::function<void()>& work) {
  unsigned char* const stack = new (std::align_val_t{4096}) unsigned char[kRoom];
  std::fill_n(stack, kRoom, kPaint);
  pthread_attr_t attributes;
  pthread_t thread;
  EXPECT_EQ(pthread_attr_init(&attributes), 0);
  EXPECT_EQ(pthread_attr_setstack(&attributes, stack, kRoom), 0);
  const auto run = [](void* what) -> void* {
    (*static_cast<const std::function<void()>*>(what))();
    return nullptr;
  };
  void* const what = const_cast<std::function<void()>*>(&work);
  EXPECT_EQ(pthread_create(&thread, &attributes, run, what), 0);
  EXPECT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
  const auto untouched =
      std::find_if(stack, stack + kRoom, [](unsigned char byte) { return byte != kPaint; });
  const auto used = static_cast<std::size_t>(stack + kRoom - untouched);
  operator delete[](stack, std::align_val_t{4096});
  return used;
}

/// All pairs of all families: those too that end in exact integers.
Family all_pairs() {
  Family all{"all", {}, {}};
  for (const Family& f : testing::drawn_families()) {
    const auto count = std::min<std::ptrdiff_t>(std::ssize(f.a), 20);
    all.a.insert(all.a.end(), f.a.begin(), f.a.begin() + count);
    all.b.insert(all.b.end(), f.b.begin(), f.b.begin() + count);
  }
  return all;
}

TEST(BatchStack, IsNoMoreThanTheHeaderSaysAtEveryLevelAndAccuracy) {
  if (!kMeasured) GTEST_SKIP() << "frames of this build are larger";
  const Family family = all_pairs();
  const Indexed in(family);
  const BodyArray array(in.bodies);
  std::vector<Vec3> axes;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : in.bodies)
    axes.push_back(body.semi_axes()), turns.push_back(body.orientation());
  const MovingBodies moving(axes, turns);
  const PairList apart{in.pairs, in.separations};
  const std::vector<Vec3> previous(family.a.size(), Vec3(0.6, 0.0, 0.8));
  std::vector<Gap> gaps(family.a.size());
  std::vector<std::uint8_t> meet(family.a.size());
  testing::Columns columns(family.a.size());
  std::size_t most = 0, of_plain = 0;
  at_every_level([&] {
    for (const Accuracy& accuracy : {Accuracy::fast(), Accuracy::standard(), Accuracy::certified(),
                                     Accuracy::standard().up_to(0.1)}) {
      most = std::max(most, stack_of([&] { signed_gaps(array, apart, gaps, accuracy); }));
      most = std::max(
          most, stack_of([&] { follow_gaps(moving, apart, previous, columns.all(), accuracy); }));
      most = std::max(most, stack_of([&] {
                        bounded_gaps(array, apart, {columns.all(), {}}, accuracy);
                      }));
      of_plain =
          std::max(of_plain, stack_of([&] { signed_gaps(family.a, family.b, gaps, accuracy); }));
    }
    most = std::max(most, stack_of([&] { overlaps(array, apart, meet); }));
  });
  std::printf("stack: %zu bytes, of plain pairs %zu\n", most, of_plain);
  EXPECT_LE(most, kPromised);
  EXPECT_LE(of_plain, kPromisedOfPlainPairs);
}

}  // namespace
}  // namespace tangency
