// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/verify/kernel_subject.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/verify/answers/truth_table.hpp>
#include <tangency/verify/families/conversions.hpp>

namespace tangency::testing {
namespace {

using verify::Answer;
using verify::Answers;
using verify::EllipsoidPair;

std::optional<verify::Relation> word(const Ellipsoid& a, const Ellipsoid& b) {
  return verify::relation_named(to_string(relation(a, b).relation));
}

Answer of_gap(double gap, double gap_error, GapStatus status, const Vec3& normal) {
  Answer answer;
  answer.overlaps = gap < 0;
  answer.gap = gap;
  answer.gap_error = gap_error;
  answer.is_local = status == GapStatus::local;
  answer.normal = {normal.x(), normal.y(), normal.z()};
  return answer;
}

Answer single_answer(const EllipsoidPair& pair, bool with_gap) {
  const Ellipsoid a = verify::to_ellipsoid(pair.a), b = verify::to_ellipsoid(pair.b);
  Answer answer;
  if (with_gap) {
    const Gap gap = signed_gap(a, b);
    answer = of_gap(gap.gap, gap.gap_error, gap.status, gap.normal);
  } else {
    answer.overlaps = overlaps(a, b);
  }
  answer.relation = word(a, b);
  return answer;
}

/// Pairs as a batch takes them: A and B in turn.
struct Columns {
  std::vector<Ellipsoid> bodies;
  std::vector<Vec3> semi_axes, centres;
  std::vector<Quaternion> orientations;
  std::vector<IndexedPair> pairs;

  explicit Columns(std::span<const EllipsoidPair> raw) {
    for (const EllipsoidPair& pair : raw) {
      const auto at = static_cast<std::uint32_t>(bodies.size());
      pairs.push_back({at, at + 1});
      for (const verify::RawEllipsoid* body : {&pair.a, &pair.b}) {
        const Ellipsoid e = verify::to_ellipsoid(*body);
        bodies.push_back(e);
        semi_axes.push_back(e.semi_axes());
        centres.push_back(e.centre());
        orientations.push_back(e.orientation());
      }
    }
  }
  PairList list() const { return {pairs, {}}; }
};

Answers lane_answers(const Columns& columns, Call call) {
  const std::size_t count = columns.pairs.size();
  std::vector<double> gaps(count), errors(count);
  std::vector<GapStatus> statuses(count);
  std::vector<Vec3> normals(count);
  const GapColumns out{.gap = gaps, .gap_error = errors, .normal = normals, .status = statuses};
  if (call == Call::moving) {
    const MovingBodies moving(columns.semi_axes,
                              PoseColumns{columns.orientations, columns.centres});
    signed_gaps(moving, columns.list(), out);
  } else {
    signed_gaps(BodyArray(columns.bodies), columns.list(), out,
                call == Call::fast ? Accuracy::fast() : Accuracy::standard());
  }
  Answers answers;
  for (std::size_t i = 0; i < count; ++i) {
    answers.emplace_back(of_gap(gaps[i], errors[i], statuses[i], normals[i]));
  }
  return answers;
}

Answers yes_no_answers(const Columns& columns) {
  std::vector<std::uint8_t> yes(columns.pairs.size());
  overlaps(BodyArray(columns.bodies), columns.list(), std::span(yes));
  Answers answers;
  for (const std::uint8_t one : yes) answers.emplace_back(Answer{.overlaps = one != 0});
  return answers;
}

}  // namespace

Answers KernelSubject::answers(std::span<const EllipsoidPair> pairs) {
  if (call_ == Call::yes_no) return yes_no_answers(Columns(pairs));
  if (call_ != Call::relation && call_ != Call::single) return lane_answers(Columns(pairs), call_);
  Answers answers;
  for (const EllipsoidPair& pair : pairs) {
    answers.emplace_back(single_answer(pair, call_ == Call::single));
  }
  return answers;
}

}  // namespace tangency::testing
