// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Our kernel as the subject of a hunt, asked by calls: no process, no table.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include <tangency/verify/hunt/subject.hpp>

namespace tangency::testing {

/// What is asked. Where gaps are, `overlaps` is their sign.
enum class Call {
  relation,  ///< relation() and overlaps()
  single,    ///< signed_gap() and relation()
  yes_no,    ///< overlaps() of many pairs
  lanes,     ///< signed_gaps() of a BodyArray
  fast,      ///< the same with Accuracy::fast()
  moving,    ///< signed_gaps() of MovingBodies
};

inline constexpr std::array<std::pair<std::string_view, Call>, 6> kCalls{{
    {"relation", Call::relation},
    {"single", Call::single},
    {"yes-no", Call::yes_no},
    {"lanes", Call::lanes},
    {"fast", Call::fast},
    {"moving", Call::moving},
}};

class KernelSubject final : public verify::Subject {
 public:
  explicit KernelSubject(Call call) : call_(call) {}
  verify::Answers answers(std::span<const verify::EllipsoidPair> pairs) override;

 private:
  Call call_;
};

}  // namespace tangency::testing
