// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/shrink.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/verify/hunt/search.hpp>

namespace tangency::inline v0::verify {
namespace {

// Chosen: as many simpler pairs as are asked at once.
constexpr std::size_t kChunk = 64;

struct Decimal {
  int digits = 0, exponent = 0;
};

// Of the shortest text that reads back to the number.
Decimal decimal(double value) {
  const std::string text = tables::to_text(std::abs(value), std::chars_format::scientific);
  const std::size_t e = text.find('e');
  const auto digits = std::ranges::count_if(text.substr(0, e), [](char c) { return c != '.'; });
  return {static_cast<int>(digits), std::atoi(text.c_str() + e + 1)};
}

// Simpler pairs of one pair, as many as may be.
class Simpler {
 public:
  Simpler(const EllipsoidPair& pair, const Nearness& near)
      : pair_(pair), near_(near), complexity_(complexity(pair)) {
    smallest();
    poses();
    shapes();
    lengths();
    digits();
    std::ranges::stable_sort(found_, {}, &Found::first);
  }

  using Found = std::pair<double, EllipsoidPair>;
  const std::vector<Found>& found() const { return found_; }

 private:
  void add(const EllipsoidPair& next) {
    const double less = complexity(next);
    if (less < complexity_ && is_fair(next)) found_.emplace_back(less, next);
  }
  // As it is, and with B moved to where the gap is again `factor` of what it was.
  void add_both(const EllipsoidPair& next, double factor = 1) {
    add(next);
    if (!is_fair(next)) return;
    const Nearness near = nearness(gap_bracket(next.a, next.b));
    for (const double gap : {factor * near_.gap, short_number(factor * near_.gap, 1)}) {
      EllipsoidPair placed = next;
      place_at_gap(placed, near, gap);
      add(placed);
    }
  }
  template <class Change>
  void with(const Change& change) {
    EllipsoidPair next = pair_;
    change(next);
    add_both(next);
  }

  // Pairs of whole numbers, upright, B along the first axis: where a fault of touches and nests,
  // which no number can be changed of alone, may be just as well.
  void smallest() {
    using Axes = std::array<double, 3>;
    constexpr std::array<Axes, 4> kAxes{{{1, 1, 1}, {2, 2, 2}, {2, 1, 1}, {3, 2, 1}}};
    constexpr std::array<double, 4> kStraight{1, 0, 0, 0};
    for (const Axes& a : kAxes) {
      for (const Axes& b : kAxes) {
        for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
          add({{{}, a, kStraight}, {{x, 0, 0}, b, kStraight}});
        }
      }
    }
  }

  void poses() {
    with([](EllipsoidPair& p) {
      for (std::size_t i = 0; i < 3; ++i) {
        p.b.centre[i] -= p.a.centre[i];
        p.a.centre[i] = 0;
      }
    });
    constexpr std::array<double, 4> kStraight{1, 0, 0, 0};
    with([&](EllipsoidPair& p) { p.a.orientation = p.b.orientation = kStraight; });
    with([&](EllipsoidPair& p) { p.a.orientation = kStraight; });
    with([&](EllipsoidPair& p) { p.b.orientation = kStraight; });
    with([](EllipsoidPair& p) { p.b.orientation = p.a.orientation; });
    with([](EllipsoidPair& p) {  // of length about 1
      for (RawEllipsoid* e : {&p.a, &p.b}) {
        double most = 0;
        for (const double v : e->orientation) most = std::max(most, std::abs(v));
        for (double& v : e->orientation) v /= most;
      }
    });
    for (std::size_t k = 0; k < 3; ++k) {  // B at its distance along one axis, and off it
      with([&](EllipsoidPair& p) {
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i) square += std::pow(p.b.centre[i] - p.a.centre[i], 2);
        p.b.centre = p.a.centre;
        p.b.centre[k] += std::sqrt(square);
      });
      with([&](EllipsoidPair& p) { p.b.centre[k] = p.a.centre[k]; });
    }
  }

  void shapes() {
    with([](EllipsoidPair& p) { p.a.semi_axes = p.b.semi_axes; });
    with([](EllipsoidPair& p) { p.b.semi_axes = p.a.semi_axes; });
    for (RawEllipsoid EllipsoidPair::*body : {&EllipsoidPair::a, &EllipsoidPair::b}) {
      for (std::size_t i = 0; i < 3; ++i) {
        with([&](EllipsoidPair& p) { (p.*body).semi_axes.fill((pair_.*body).semi_axes[i]); });
        const std::size_t j = (i + 1) % 3;
        with([&](EllipsoidPair& p) { (p.*body).semi_axes[j] = (p.*body).semi_axes[i]; });
        with([&](EllipsoidPair& p) { (p.*body).semi_axes[i] = (p.*body).semi_axes[j]; });
        with([&](EllipsoidPair& p) { (p.*body).semi_axes[i] = 1; });
      }
      with([&](EllipsoidPair& p) { std::ranges::sort((p.*body).semi_axes); });
    }
  }

  // All lengths by a common factor, so that some semi-axis is about 1, and some decades up and
  // down.
  void lengths() {
    std::vector<int> shifts{-9, -6, -3, -1, 1, 3, 6, 9};
    for (const double r : {pair_.a.semi_axes[0], pair_.a.semi_axes[1], pair_.a.semi_axes[2],
                           pair_.b.semi_axes[0], pair_.b.semi_axes[1], pair_.b.semi_axes[2]}) {
      shifts.push_back(-decimal(r).exponent);
    }
    for (const int shift : shifts) {
      const double factor = std::pow(10.0, shift);
      EllipsoidPair next = pair_;
      for (RawEllipsoid* e : {&next.a, &next.b}) {
        for (double& v : e->centre) v = short_number(v * factor, 16);
        for (double& v : e->semi_axes) v = short_number(v * factor, 16);
      }
      add_both(next, factor);
    }
  }

  void digits() {
    const std::array<double, 20> all = numbers(pair_);
    for (const int count : {1, 2, 3, 4, 6, 8, 10, 12, 14}) {
      std::array<double, 20> shorter = all, apart = all;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const double value = short_number(all[i], count);
        shorter[i] = value;
        if (i < 10 || i >= 13) apart[i] = value;  // all but where B is
        if (value == all[i]) continue;
        std::array<double, 20> one = all;
        one[i] = value;
        add_both(pair_of(one));
      }
      add(pair_of(shorter));
      add_both(pair_of(apart));
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::array<double, 20> one = all;
      one[i] = 0;
      add_both(pair_of(one));
    }
  }

  const EllipsoidPair& pair_;
  const Nearness& near_;
  double complexity_;
  std::vector<Found> found_;
};

// The first of the simpler pairs, the simplest first, that has the fault; false without one, or
// where the hunt has to end.
bool take_simpler(Subject& subject, Judge& judge, const std::string& fault, std::size_t most,
                  Shrunk& best) {
  const Simpler simpler(best.pair, best.verdict.near);
  const auto& found = simpler.found();
  for (std::size_t from = 0; from < found.size() && best.answers < most; from += kChunk) {
    std::vector<EllipsoidPair> pairs;
    for (std::size_t i = from; i < std::min(from + kChunk, found.size()); ++i) {
      pairs.push_back(found[i].second);
    }
    const Answers answers = subject.answers(pairs);
    best.answers += answers.size();
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const Verdict verdict = judge.verdict(pairs[i], answers[i]);
      if (verdict.fault != fault) continue;
      best.pair = pairs[i];
      best.verdict = verdict;
      best.answer = answers[i].value_or(Answer{});
      return true;
    }
    if (answers.size() < pairs.size()) return false;
  }
  return false;
}

}  // namespace

double complexity(const EllipsoidPair& pair) {
  // Chosen: a number that is 1 costs less than any other, one that stands there already half.
  const auto cost = [](double value) {
    if (value == 0) return 0.0;
    if (value == 1) return 0.2;
    const Decimal d = decimal(value);
    return 0.5 + d.digits + 0.05 * std::abs(d.exponent) + (value < 0 ? 0.1 : 0.0);
  };
  double sum = 0;
  std::vector<double> seen;
  for (const double value : numbers(pair)) {
    const double size = std::abs(value);
    const bool again = std::ranges::find(seen, size) != seen.end();
    sum += again ? cost(value) / 2 : cost(value);
    seen.push_back(size);
  }
  return sum;
}

int most_digits(const EllipsoidPair& pair) {
  int most = 0;
  for (const double value : numbers(pair)) {
    if (value != 0) most = std::max(most, decimal(value).digits);
  }
  return most;
}

Shrunk shrunk(Subject& subject, Judge& judge, const EllipsoidPair& start, const std::string& fault,
              std::size_t most) {
  Shrunk best{start, {}, {}, 0};
  const Answers first = subject.answers(std::span(&start, 1));
  if (first.empty()) return best;
  best.answers = 1;
  best.verdict = judge.verdict(start, first.front());
  best.answer = first.front().value_or(Answer{});
  if (best.verdict.fault != fault) return best;
  while (take_simpler(subject, judge, fault, most, best)) {
  }
  return best;
}

}  // namespace tangency::inline v0::verify
