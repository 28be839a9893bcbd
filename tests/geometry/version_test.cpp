// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>

#include <tangency/version.hpp>

namespace tangency {
namespace {

TEST(Version, OfTheLibraryIsThatOfItsHeaders) {
  const std::string numbers = std::to_string(TANGENCY_VERSION_MAJOR) + '.' +
                              std::to_string(TANGENCY_VERSION_MINOR) + '.' +
                              std::to_string(TANGENCY_VERSION_PATCH);
  EXPECT_EQ(version(), numbers);
  EXPECT_STREQ(version(), TANGENCY_VERSION_STRING);
}

}  // namespace
}  // namespace tangency
