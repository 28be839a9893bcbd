// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <ios>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/motion.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/overlap_batch.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/ray.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/strided.hpp>
#include <tangency/geometry/time_batch.hpp>
#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/geometry/vectors.hpp>
#include <tangency/version.hpp>

namespace {

// A block of C++ of README or guide: where it stands, what it does, and what the page says it
// prints.
struct Example {
  const char* place;
  void (*run)();
  const char* printed;
};

}  // namespace

// Pages show parts of programs: not all that they name is used.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include "guide_examples.inc"
#pragma GCC diagnostic pop

namespace {

// What std::cout takes while it lives; it ends in the form that it had.
class Printed {
 public:
  Printed() : before_(std::cout.rdbuf(text_.rdbuf())) { form_.copyfmt(std::cout); }
  ~Printed() {
    std::cout.rdbuf(before_);
    std::cout.copyfmt(form_);
  }
  Printed(const Printed&) = delete;
  Printed& operator=(const Printed&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
  std::ios form_{nullptr};
};

TEST(Guide, EveryExampleInCppPrintsWhatItsPageSays) {
  ASSERT_GT(std::size(kExamples), 10U);
  for (const Example& example : kExamples) {
    std::string text;
    {
      const Printed printed;
      example.run();
      text = printed.text();
    }
    EXPECT_EQ(text, example.printed) << example.place;
  }
}

}  // namespace
