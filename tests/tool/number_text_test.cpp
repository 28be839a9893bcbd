// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::testing {
namespace {

using tables::formatted, tables::rounded_text, tables::to_text;

RC_GTEST_PROP(NumberText, ReadsBackToTheSameDouble, (std::uint64_t bits)) {
  const auto x = std::bit_cast<double>(bits);
  RC_PRE(std::isfinite(x));
  double back = 0;
  RC_ASSERT(!tables::parse_number(to_text(x), back));
  RC_ASSERT(std::bit_cast<std::uint64_t>(back) == bits);
}

TEST(NumberText, IsTheShortestOrAsTheFormatSays) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(1e300), "1e+300");
  EXPECT_EQ(to_text(1e15, std::chars_format::fixed), "1000000000000000");
  EXPECT_EQ(to_text(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

RC_GTEST_PROP(NumberText, RoundsAsAStreamDoes, (std::uint64_t bits)) {
  const auto x = std::bit_cast<double>(bits);
  const int digits = *rc::gen::inRange(1, 18);
  std::ostringstream stream;
  stream << std::setprecision(digits) << x;
  RC_ASSERT(rounded_text(x, digits) == stream.str());
}

TEST(NumberText, FormattedTextIsCutAt511Characters) {
  EXPECT_EQ(formatted("%d of %s", 2, "three"), "2 of three");
  const std::string cell(600, 'x');
  EXPECT_EQ(formatted("%s", cell.c_str()), cell.substr(0, 511));
}

}  // namespace
}  // namespace tangency::testing
