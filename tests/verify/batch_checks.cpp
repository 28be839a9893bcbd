// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/overlap_batch.hpp>
#include <tangency/tests/support/same_bits.hpp>
#include <tangency/tests/verify/batch_part.hpp>

namespace tangency::testing {
namespace {

using verify::GapTruth;
using verify::Real;
using Wide = long double;

constexpr double kU = kUnitRoundoff;
// What a sum or difference of these numbers is rounded by in an extended double.
constexpr Wide kRounded = 1 + 0x1p-60L;

// Of L: verify/oracles/gap.hpp. Below it the truth is a touch, as the exact relation confirms.
const Real kErrorOfOracle("1e-139");

int sign(double x) { return (x > 0) - (x < 0); }

std::string described(const Gap& gap) {
  char text[200];
  std::snprintf(text, sizeof text, "gap %a +- %a normal %a,%a,%a status %d tier %d", gap.gap,
                gap.gap_error, gap.normal[0], gap.normal[1], gap.normal[2],
                static_cast<int>(gap.status), static_cast<int>(gap.tier));
  return text;
}

double largest_aspect(const Ellipsoid& a, const Ellipsoid& b) {
  return std::max(a.largest_semi_axis() / a.smallest_semi_axis(),
                  b.largest_semi_axis() / b.smallest_semi_axis());
}

Wide norm(const Vec3& v) {
  return std::sqrt(Wide(v[0]) * v[0] + Wide(v[1]) * v[1] + Wide(v[2]) * v[2]);
}
Wide distance(const Vec3& v, const Vec3& w) {
  Wide square = 0;
  for (int k = 0; k < 3; ++k) square += (Wide(v[k]) - w[k]) * (Wide(v[k]) - w[k]);
  return std::sqrt(square);
}

/// One call of the batch, for messages and for what it promises.
struct Call {
  std::string name;
  Accuracy accuracy;
  double bound;   ///< of gap_error, in u L
  bool in_place;  ///< by the centres, unrounded; else by the separations
  bool following;
  bool moving;
};

class Checker {
 public:
  Checker(const Part& part, std::string level, Tally& tally)
      : part_(part), level_(std::move(level)), tally_(tally) {}

  void broken(Breach breach, std::size_t i, const std::string& what) {
    ++tally_.breaches[static_cast<std::size_t>(breach)];
    if (!tally_.first.empty()) return;
    tally_.first = std::string(to_string(breach)) + ", " + level_ + ", " + what + "\n  " +
                   printed(part_.raw[i]);
  }

  void gaps(const Call& call, const std::vector<Gap>& gaps) {
    for (std::size_t i = 0; i < gaps.size(); ++i) gap(call, i, gaps[i]);
  }

  void same(const std::string& what, std::size_t i, const Gap& gap, const Gap& other) {
    if (!same_bits(gap, other))
      broken(Breach::bits, i, what + ": " + described(gap) + ", and " + described(other));
  }

  // gap_batch.hpp (9)
  void cutoff(const std::string& call, const std::vector<Gap>& limited,
              const std::vector<Gap>& whole, const std::vector<Single>& singles,
              const std::vector<GapTruth>& truths, double cutoff) {
    for (std::size_t i = 0; i < limited.size(); ++i) {
      const Gap &gap = limited[i], &without = whole[i], &single = singles[i].gap;
      bool holds =
          same_bits(gap, without) && without.gap - without.gap_error <= cutoff * (1 + 2 * kU);
      if (gap.status == GapStatus::beyond) {
        holds =
            gap.gap > cutoff && Wide(gap.gap) <= (Wide(single.gap) + single.gap_error) * kRounded;
        if (i < truths.size() && truths[i].global)
          holds = holds &&
                  Real(gap.gap) <= truths[i].gap + kErrorOfOracle * static_cast<double>(size(i));
      }
      ++tally_.answers;
      if (!holds)
        broken(Breach::cutoff, i, call + ": " + described(gap) + ", without " + described(without));
    }
  }

 private:
  const Single& single_of(const Call& call, std::size_t i) const {
    return (call.following ? part_.followed : call.in_place ? part_.placed : part_.separated)[i];
  }

  Wide size(std::size_t i) const {
    return norm(part_.separations[i]) + part_.a[i].largest_semi_axis() +
           part_.b[i].largest_semi_axis();
  }

  void gap(const Call& call, std::size_t i, const Gap& gap) {
    ++tally_.answers;
    const Single& single = single_of(call, i);
    const auto said = [&] {
      return call.name + ": " + described(gap) + ", single " + described(single.gap) +
             ", previous " + printed_normal(i);
    };
    if (gap.status != single.gap.status) return broken(Breach::status, i, said());
    if (sign(gap.gap) != sign(single.gap.gap)) return broken(Breach::sign, i, said());
    const bool in_lane = !same_bits(gap, single.gap);
    judge(call, i, gap, in_lane);
    if (!in_lane) return;
    const Wide off = std::abs(Wide(gap.gap) - single.gap.gap);
    const bool beyond = !(off <= (Wide(gap.gap_error) + single.gap.gap_error) * kRounded);
    if (gap.status == GapStatus::local) {
      of_branch(call, i, gap, beyond, said);
    } else if (beyond) {
      broken(Breach::beyond, i, said());
    } else {
      bound(call, i, gap, said);
      contact(call, i, gap, single, said);
    }
  }

  std::string printed_normal(std::size_t i) const {
    char text[100];
    const Vec3& n = part_.previous[i];
    std::snprintf(text, sizeof text, "%a,%a,%a", n[0], n[1], n[2]);
    return text;
  }

  // gap_batch.hpp (1), of a `local` answer.
  template <class Said>
  void of_branch(const Call& call, std::size_t i, const Gap& gap, bool beyond, const Said& said) {
    if (!(call.following && call.moving)) {
      if (beyond) broken(Breach::beyond, i, said());
      return;
    }
    tally_.other_branch += beyond;
    const Gap& global = part_.separated[i].gap;
    const bool below = global.status != GapStatus::ok ||
                       Wide(gap.gap) - gap.gap_error <= (Wide(global.gap) + global.gap_error) +
                                                            std::abs(Wide(gap.gap)) * 0x1p-60L;
    if (!below || !(gap.gap < 0)) broken(Breach::beyond, i, said());
    const Vec3 before = part_.previous[i].normalized();
    if (beyond && !(distance(gap.normal, before) <= 0.15L)) broken(Breach::contact, i, said());
  }

  // gap_batch.hpp (4)
  template <class Said>
  void bound(const Call& call, std::size_t i, const Gap& gap, const Said& said) {
    if (largest_aspect(part_.a[i], part_.b[i]) > 100) return;
    const Wide tolerance = Wide(call.accuracy.of_size) * size(i) + call.accuracy.length;
    if (!(gap.gap_error <= (Wide(call.bound) * kU * size(i) + tolerance) * (1 + 4 * Wide(kU))))
      broken(Breach::bound, i, said());
  }

  // The normal is a unit vector; it and the arms are within contact_bounds() where they are asked
  // for to rounding, and else the normal within what Accuracy says.
  template <class Said>
  void contact(const Call& call, std::size_t i, const Gap& gap, const Single& single,
               const Said& said) {
    const Ellipsoid &a = part_.here[i], &b = part_.there[i];
    bool holds = std::abs(norm(gap.normal) - 1) <= 8 * Wide(kU);
    const Wide turn = distance(gap.normal, single.gap.normal);
    const bool unique = single.bounds.normal < 1;
    if (unique && !call.accuracy.normals) {
      const Wide radii = Wide(gap.gap) - gap.gap_error + a.least_radius() + b.least_radius();
      if (radii > 0) {
        const Wide promised = 2 * std::sqrt(Wide(gap.gap_error) / radii);
        holds = holds && turn <= promised + single.bounds.normal + 8 * Wide(kU);
      }
    } else if (unique) {
      const ContactBounds bounds = call.in_place ? contact_bounds(part_.a[i], part_.b[i], gap)
                                                 : contact_bounds(a, b, part_.separations[i], gap);
      holds = holds && turn <= Wide(bounds.normal) + single.bounds.normal &&
              distance(gap.arm_a, single.gap.arm_a) <= Wide(bounds.arm_a) + single.bounds.arm_a &&
              distance(gap.arm_b, single.gap.arm_b) <= Wide(bounds.arm_b) + single.bounds.arm_b;
    }
    // p_B - p_A = g n along n, to the errors.
    Wide along = -Wide(gap.gap);
    for (int k = 0; k < 3; ++k) {
      along += (Wide(part_.separations[i][k]) + gap.arm_b[k] - gap.arm_a[k]) * gap.normal[k];
    }
    holds = holds && std::abs(along) <= 2 * Wide(gap.gap_error) + 32 * Wide(kU) * size(i);
    if (!holds) broken(Breach::contact, i, said());
  }

  void judge(const Call& call, std::size_t i, const Gap& gap, bool in_lane) {
    const auto& truths = call.in_place ? part_.truth : part_.truth_separated;
    if (i >= truths.size()) return;
    const GapTruth& truth = truths[i];
    ++tally_.judged;
    const Real off_by_oracle = kErrorOfOracle * static_cast<double>(size(i));
    const Real below = Real(gap.gap) - truth.gap;  // of the best that is known
    bool holds = below <= Real(gap.gap_error) + Real(truth.unproven) + off_by_oracle;
    if (gap.status == GapStatus::ok && truth.global) {
      const Real error = abs(below);
      holds = error <= Real(gap.gap_error) + off_by_oracle;
      if (in_lane && gap.gap_error > 0)
        tightest(call, i, (error / gap.gap_error).convert_to<double>());
    }
    if (truth.global)
      holds = holds && sign(gap.gap) == (abs(truth.gap) <= off_by_oracle ? 0 : truth.gap.sign());
    if (!holds)
      broken(Breach::oracle, i, call.name + ": " + described(gap) + ", true " + truth.gap.str(25));
  }

  void tightest(const Call& call, std::size_t i, double ratio) {
    Tightness& most = call.accuracy.normals ? tally_.rounding : tally_.tolerance;
    if (ratio > most.ratio) most = {ratio, part_.raw[i]};
  }

  const Part& part_;
  std::string level_;
  Tally& tally_;
};

struct Point {
  const char* name;
  Accuracy accuracy;
};

// Lengths are those of the first pair: of a part of other sizes they mean from nothing to anything.
std::vector<Point> points(const Part& part) {
  const double size = part.separations[0].stableNorm() + part.a[0].largest_semi_axis() +
                      part.b[0].largest_semi_axis();
  return {{"standard", Accuracy::standard()},
          {"fast", Accuracy::fast()},
          {"certified", Accuracy::certified()},
          {"within 2^-10 L", Accuracy::within(0x1p-10 * size)},
          {"within 2^-40 L", Accuracy::within(0x1p-40 * size)}};
}

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  for (std::size_t i = count; i-- > 1;) std::swap(order[i], order[random() % (i + 1)]);
  return order;
}

template <class T>
std::vector<T> reordered(const std::vector<T>& values, std::span<const std::size_t> order) {
  std::vector<T> some;
  some.reserve(order.size());
  for (const std::size_t i : order) some.push_back(values[i]);
  return some;
}

/// The bodies of a part in every form that the batch takes, made with the instruction set that is
/// chosen now.
struct Forms {
  explicit Forms(const Part& part)
      : array(part.bodies),
        owned(part.semi_axes, PoseColumns{part.orientations, part.centres}),
        looking(std::span<const Vec3>(part.semi_axes),
                std::span<const Quaternion>(part.orientations)) {}
  BodyArray array;
  MovingBodies owned, looking;
};

/// All calls for gaps at one Accuracy.
class GapCalls {
 public:
  GapCalls(const Part& part, const Forms& forms, const Point& point, Checker& check)
      : part_(part),
        bodies_(forms.array),
        owned_(forms.owned),
        looking_(forms.looking),
        point_(point),
        check_(check) {}

  void run(bool to_the_bit, std::uint64_t seed, Tally& tally) {
    const PairList placed{part_.pairs, {}}, apart{part_.pairs, part_.separations};
    const auto cold = [&](const auto& bodies, const PairList& list) {
      return [&, list](std::span<Gap> gaps, int) { signed_gaps(bodies, list, gaps, at()); };
    };
    const std::vector<Gap> array = answers("signed", false, true, cold(bodies_, placed));
    const std::vector<Gap> array_apart =
        answers("signed, separated", false, false, cold(bodies_, apart));
    const std::vector<Gap> owned = moving("signed, owned", false, true, owned_, placed);
    const std::vector<Gap> looking = moving("signed, looking", false, false, looking_, apart);
    std::vector<Gap> follow(part_.size());
    follow_gaps(bodies_, apart, part_.previous, follow, at());
    check_.gaps({name("followed"), at(), 16, false, true, false}, follow);
    const std::vector<Gap> follow_moving =
        moving("followed, looking", true, false, looking_, apart);
    if (std::string(point_.name) == "standard") {
      for (std::size_t i = 0; i < array.size(); ++i) {
        ++tally.tiers[static_cast<std::size_t>(array[i].tier)];
        tally.of_single_calls += same_bits(array[i], part_.placed[i].gap);
      }
    }
    up_to_cutoffs(array, follow_moving);
    if (!to_the_bit) return;
    std::vector<Gap> other(part_.size());
    const auto compare = [&](const char* what, const std::vector<Gap>& expected) {
      for (std::size_t i = 0; i < other.size(); ++i)
        check_.same(name(what), i, other[i], expected[i]);
    };
    signed_gaps(part_.a, part_.b, other, at());
    compare("plain pairs", array);
    signed_gaps(part_.a, part_.b, part_.separations, other, at());
    compare("plain pairs, separated", array_apart);
    signed_gaps(bodies_, placed, other, at(), 3);
    compare("3 threads", array);
    follow_gaps(bodies_, placed, part_.previous, other, at(), 2);
    compare("followed by the centres", follow);
    other = moving_answers(true, owned_, placed, part_.previous);
    compare("followed, owned", follow_moving);
    in_another_order(array, array_apart, owned, looking, follow_moving, seed);
  }

 private:
  const Accuracy& at() const { return point_.accuracy; }
  std::string name(const char* call) const { return std::string(call) + ", " + point_.name; }

  template <class Ask>
  std::vector<Gap> answers(const char* call, bool following, bool in_place, const Ask& ask) {
    std::vector<Gap> gaps(part_.size());
    ask(gaps, 1);
    check_.gaps({name(call), at(), 16, in_place, following, false}, gaps);
    return gaps;
  }

  // With a cutoff that half of the pairs are about: in the lanes of all bodies and of those
  // followed.
  void up_to_cutoffs(const std::vector<Gap>& array, const std::vector<Gap>& follow_moving) {
    const auto cutoff_of = [](const std::vector<Gap>& gaps) {
      std::vector<double> positive{0.0};
      for (const Gap& gap : gaps)
        if (gap.gap > 0 && std::isfinite(gap.gap)) positive.push_back(gap.gap);
      const auto middle = positive.begin() + std::ssize(positive) / 2;
      std::ranges::nth_element(positive, middle);
      return *middle;
    };
    const double cutoff = cutoff_of(array), cutoff_of_moving = cutoff_of(follow_moving);
    std::vector<Gap> limited(part_.size());
    signed_gaps(bodies_, {part_.pairs, {}}, limited, at().up_to(cutoff));
    check_.cutoff(name("signed, up to"), limited, array, part_.placed, part_.truth, cutoff);
    limited = moving_answers(true, looking_, {part_.pairs, part_.separations}, part_.previous,
                             at().up_to(cutoff_of_moving));
    check_.cutoff(name("followed, looking, up to"), limited, follow_moving, part_.separated,
                  part_.truth_separated, cutoff_of_moving);
  }

  std::vector<Gap> moving_answers(bool following, const MovingBodies& bodies, const PairList& list,
                                  std::span<const Vec3> previous) const {
    return moving_answers(following, bodies, list, previous, at());
  }

  static std::vector<Gap> moving_answers(bool following, const MovingBodies& bodies,
                                         const PairList& list, std::span<const Vec3> previous,
                                         Accuracy accuracy) {
    const std::size_t count = list.pairs.size();
    std::vector<double> gap(count), gap_error(count);
    std::vector<Vec3> normal(count), arm_a(count), arm_b(count);
    std::vector<GapStatus> status(count);
    std::vector<GapTier> tier(count);
    const GapColumns columns{gap, gap_error, normal, arm_a, arm_b, status, tier};
    if (following)
      follow_gaps(bodies, list, previous, columns, accuracy);
    else
      signed_gaps(bodies, list, columns, accuracy);
    std::vector<Gap> gaps;
    gaps.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      gaps.push_back({gap[i], normal[i], arm_a[i], arm_b[i], gap_error[i], status[i], tier[i]});
    }
    return gaps;
  }

  std::vector<Gap> moving(const char* call, bool following, bool in_place,
                          const MovingBodies& bodies, const PairList& list) {
    std::vector<Gap> gaps = moving_answers(following, bodies, list, part_.previous);
    check_.gaps({name(call), at(), 26, in_place, following, true}, gaps);
    return gaps;
  }

  // Any order, of any number of them, with other neighbours in a block.
  void in_another_order(const std::vector<Gap>& array, const std::vector<Gap>& array_apart,
                        const std::vector<Gap>& owned, const std::vector<Gap>& looking,
                        const std::vector<Gap>& followed, std::uint64_t seed) {
    const std::vector<std::size_t> whole = shuffled(part_.size(), seed);
    const std::size_t count = seed % 3 == 0 ? whole.size() : 1 + seed % whole.size();
    const std::span<const std::size_t> order = std::span(whole).first(count);
    const auto pairs = reordered(part_.pairs, order);
    const auto separations = reordered(part_.separations, order);
    const auto previous = reordered(part_.previous, order);
    std::vector<Gap> gaps(count);
    const auto compare = [&](const char* what, const std::vector<Gap>& expected) {
      for (std::size_t i = 0; i < count; ++i)
        check_.same(name(what), order[i], gaps[i], expected[order[i]]);
    };
    signed_gaps(bodies_, {pairs, {}}, gaps, at());
    compare("signed, shuffled", array);
    signed_gaps(bodies_, {pairs, separations}, gaps, at());
    compare("signed, separated, shuffled", array_apart);
    gaps = moving_answers(false, owned_, {pairs, {}}, previous);
    compare("signed, owned, shuffled", owned);
    gaps = moving_answers(false, looking_, {pairs, separations}, previous);
    compare("signed, looking, shuffled", looking);
    gaps = moving_answers(true, looking_, {pairs, separations}, previous);
    compare("followed, looking, shuffled", followed);
  }

  const Part& part_;
  const BodyArray& bodies_;
  const MovingBodies &owned_, &looking_;
  const Point& point_;
  Checker& check_;
};

// gap_batch.hpp (6), and the point of (7).
template <class Bodies>
void check_bounded(const Part& part, const Bodies& bodies, const PairList& list,
                   const std::vector<Single>& singles, const Point& point, const char* form,
                   Checker& check) {
  const std::size_t count = part.size();
  std::vector<double> gap(count), gap_error(count), above(count);
  std::vector<GapStatus> status(count);
  bounded_gaps(bodies, list, {{.gap = gap, .gap_error = gap_error, .status = status}, above},
               point.accuracy);
  for (std::size_t i = 0; i < count; ++i) {
    const Gap& single = singles[i].gap;
    const Wide low = Wide(gap[i]) - gap_error[i], high = Wide(gap[i]) + above[i];
    const Wide slack = 0x1p-60L * std::abs(Wide(gap[i]));
    bool holds = Wide(single.gap) - single.gap_error <= high + slack;
    if (single.status == GapStatus::ok)
      holds = holds && Wide(single.gap) + single.gap_error >= low - slack;
    if (gap[i] > gap_error[i]) holds = holds && single.gap > 0;
    if (gap[i] < -above[i]) holds = holds && single.gap < 0;
    if (holds) continue;
    char text[160];
    std::snprintf(text, sizeof text, "bounded, %s, %s: %a - %a + %a status %d, single ", form,
                  point.name, gap[i], gap_error[i], above[i], static_cast<int>(status[i]));
    check.broken(Breach::enclosure, i, text + described(single));
  }
}

// gap_batch.hpp (7)
void check_points(const Part& part, const BodyArray& bodies, Checker& check) {
  const std::size_t count = part.size();
  std::vector<Vec3> point(count), arm_a(count), arm_b(count);
  std::vector<GapStatus> status(count);
  signed_gaps(bodies, {part.pairs, part.separations},
              {.arm_a = arm_a, .arm_b = arm_b, .status = status, .point = point});
  for (std::size_t i = 0; i < count; ++i) {
    const Wide size =
        norm(part.separations[i]) + part.a[i].largest_semi_axis() + part.b[i].largest_semi_axis();
    Wide off = 0;
    for (int k = 0; k < 3; ++k) {
      const Wide middle = (Wide(part.separations[i][k]) + arm_a[i][k] + arm_b[i][k]) / 2;
      off = std::max(off, std::abs(middle - point[i][k]));
    }
    if (!(off <= 8 * kU * size)) check.broken(Breach::contact, i, "point is not the middle");
  }
}

// overlap_batch.hpp (1); where the filter answers it is right.
void check_yes_no(const Part& part, const BodyArray& bodies, std::uint64_t seed, Checker& check) {
  const std::size_t count = part.size();
  const std::vector<std::size_t> order = shuffled(count, seed);
  const auto compare = [&](const char* what, const auto& answers, const std::vector<char>& expected,
                           bool in_order) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = in_order ? k : order[k];
      if (answers[k] != expected[i]) check.broken(Breach::yes_no, i, what);
    }
  };
  const std::unique_ptr<bool[]> own(new bool[count]);
  overlaps(bodies, {part.pairs, {}}, std::span(own.get(), count));
  compare("overlaps", own, part.overlaps, true);
  std::vector<std::uint8_t> bytes(count, 7);
  overlaps(bodies, {part.pairs, part.separations}, bytes, 2);
  compare("overlaps, separated", bytes, part.overlaps_separated, true);
  const auto pairs = reordered(part.pairs, order);
  overlaps(bodies, {pairs, {}}, bytes);
  compare("overlaps, shuffled", bytes, part.overlaps, false);
  std::vector<std::optional<bool>> known(count);
  overlaps_by_filter(bodies, {part.pairs, {}}, known);
  for (std::size_t i = 0; i < count; ++i) {
    if (known[i] && *known[i] != static_cast<bool>(part.overlaps[i]))
      check.broken(Breach::yes_no, i, "overlaps_by_filter");
  }
}

}  // namespace

std::string printed(const verify::EllipsoidPair& pair) {
  std::string text;
  const auto add = [&](const auto& numbers) {
    char number[40];
    for (const double x : numbers) {
      std::snprintf(number, sizeof number, text.empty() ? "%a" : ",%a", x);
      text += number;
    }
  };
  for (const verify::RawEllipsoid* body : {&pair.a, &pair.b})
    add(body->centre), add(body->semi_axes), add(body->orientation);
  return text;
}

const char* to_string(Breach breach) {
  static constexpr std::array kNames{"sign",      "status", "beyond", "bound",  "contact",
                                     "enclosure", "yes/no", "bits",   "cutoff", "oracle"};
  static_assert(kNames.size() == kBreaches);
  return kNames[static_cast<std::size_t>(breach)];
}

void Tally::add(const Tally& other) {
  pairs += other.pairs, answers += other.answers, judged += other.judged;
  for (std::size_t k = 0; k < kBreaches; ++k) breaches[k] += other.breaches[k];
  for (std::size_t k = 0; k < tiers.size(); ++k) tiers[k] += other.tiers[k];
  of_single_calls += other.of_single_calls, other_branch += other.other_branch;
  if (other.rounding.ratio > rounding.ratio) rounding = other.rounding;
  if (other.tolerance.ratio > tolerance.ratio) tolerance = other.tolerance;
  if (first.empty()) first = other.first;
}

bool Tally::kept() const {
  return std::ranges::all_of(breaches, [](long count) { return count == 0; });
}

void check_singles(const Part& part, Tally& tally) {
  Checker check(part, "single calls", tally);
  tally.pairs += static_cast<long>(part.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    const bool below = part.placed[i].gap.gap < 0;
    if (below != static_cast<bool>(part.overlaps[i])) check.broken(Breach::sign, i, "signed_gap");
  }
  for (std::size_t i = 0; i < part.truly_overlap.size(); ++i) {
    if (part.truly_overlap[i] != part.overlaps[i]) check.broken(Breach::oracle, i, "overlaps");
  }
}

void check_part(const Part& part, const std::string& level, std::size_t number, Tally& tally) {
  if (part.size() == 0) return;
  Checker check(part, level, tally);
  const Forms forms(part);
  const std::vector<Point> all = points(part);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool to_the_bit = number % all.size() == k;
    GapCalls(part, forms, all[k], check).run(to_the_bit, number, tally);
  }
  const Point& point = all[number % all.size()];
  check_bounded(part, forms.array, {part.pairs, {}}, part.placed, point, "array", check);
  check_bounded(part, forms.looking, {part.pairs, part.separations}, part.separated, point,
                "looking", check);
  check_points(part, forms.array, check);
  check_yes_no(part, forms.array, number, check);
}

}  // namespace tangency::testing
