// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <thread>

#include <tangency/geometry/tables/command_line.hpp>

namespace tangency::testing {
namespace {

void call_what_may_not_throw(void (*what)()) noexcept { what(); }

void end_memory() { throw std::bad_alloc(); }
void fail() { throw std::logic_error("a fault"); }

// geometry/tables/command_line.hpp (4)
TEST(Memory, ThatEndsInACallThatMayNotThrowIsSaidInALineWithTheStatus2) {
  const tables::Program program("prog", "A program");
  EXPECT_EXIT(call_what_may_not_throw(end_memory), ::testing::ExitedWithCode(2),
              "^tests_faults: out of memory\n$");
  EXPECT_EXIT(std::thread(call_what_may_not_throw, end_memory).join(), ::testing::ExitedWithCode(2),
              "^tests_faults: out of memory\n$");
}

TEST(Memory, IsNotBlamedForWhatElseIsThrown) {
  const tables::Program program("prog", "A program");
  EXPECT_EXIT(call_what_may_not_throw(fail), ::testing::KilledBySignal(SIGABRT), "a fault");
}

}  // namespace
}  // namespace tangency::testing
