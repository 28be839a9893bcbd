// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/findings.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <exception>
#include <map>
#include <set>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::verify {
namespace {

std::string names_of(std::uint16_t set) {
  std::string text;
  for (unsigned bit = 1; bit <= kNear; bit *= 2) {
    if ((set & bit) == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(trait_name(static_cast<Trait>(bit)));
  }
  return text.empty() ? "plain" : text;
}

struct Places {
  std::string fault;
  std::size_t count;                                        // of its answers
  std::vector<std::pair<std::uint16_t, const Elite*>> all;  // those with fewest traits first
};

// By kind of fault, the most frequent first.
std::vector<Places> places_of(const Search& search) {
  std::vector<Places> places;
  for (const auto& [kind, elite] : search.archive()) {
    const auto& [fault, set] = kind;
    if (fault.empty()) continue;
    if (places.empty() || places.back().fault != fault) {
      places.push_back({fault, search.faults().at(fault).count, {}});
    }
    places.back().all.emplace_back(set, &elite);
  }
  for (Places& one : places) {
    std::ranges::stable_sort(one.all, {}, [](const auto& at) { return std::popcount(at.first); });
  }
  std::ranges::stable_sort(places, std::ranges::greater(), &Places::count);
  return places;
}

std::string said_text(const Answer& answer) {
  std::string text;
  const auto add = [&](const char* what, const std::string& value) {
    text += (text.empty() ? "" : ", ") + std::string(what) + ' ' + value;
  };
  if (answer.relation) add("relation", std::string(name(*answer.relation)));
  if (answer.overlaps) add("overlaps", *answer.overlaps ? "1" : "0");
  if (answer.gap) add("gap", tables::to_text(*answer.gap));
  if (answer.gap_error) add("gap_error", tables::to_text(*answer.gap_error));
  if (answer.normal) {
    const auto& n = *answer.normal;
    add("normal",
        tables::to_text(n[0]) + ' ' + tables::to_text(n[1]) + ' ' + tables::to_text(n[2]));
  }
  return text.empty() ? "nothing" : text;
}

// By 100 digits: findings are few. Nothing where the oracle does not prove it, or does not arrive.
std::optional<double> true_gap(const EllipsoidPair& pair) {
  try {
    const auto truth = common_normal_truth(pair);
    return truth ? std::optional(truth->gap.convert_to<double>()) : std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

HuntFinding finding(const Search& search, Subject& subject, const std::string& fault,
                    const std::pair<std::uint16_t, const Elite*>& place, std::size_t answers) {
  const auto& [set, elite] = place;
  HuntFinding one{fault, elite->source, {}, elite->found, elite->pair, {}};
  one.simple = shrunk(subject, search.judge(), elite->pair, fault, answers);
  one.asked = one.simple.answers > 0;
  if (!one.asked) {
    one.simple.verdict.fault = fault;
    one.simple.verdict.error = elite->error;
    one.simple.verdict.near = elite->near;
    one.simple.verdict.truth = exact_relation(elite->pair.a, elite->pair.b).relation;
  }
  one.again = one.simple.verdict.fault == fault;
  one.traits = names_of(one.again ? traits(one.simple.pair, one.simple.verdict.near) : set);
  return one;
}

// What a corpus may call a family.
std::string family_name(std::string text) {
  for (char& c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != ' ') c = '-';
  }
  return text;
}

// The `most` simplest of those of one kind that have traits of their own.
std::vector<HuntFinding> of_a_kind(const Search& search, Subject& subject, const Places& places,
                                   std::size_t most, std::size_t answers) {
  // Chosen: a few more are made simple than are kept, since some stay as they are.
  const std::size_t tried = std::min(places.all.size(), most + 1);
  std::vector<HuntFinding> found;
  for (std::size_t i = 0; i < tried; ++i) {
    found.push_back(finding(search, subject, places.fault, places.all[i], answers));
  }
  std::ranges::stable_sort(found, {},
                           [](const HuntFinding& one) { return complexity(one.simple.pair); });
  std::vector<HuntFinding> kept;
  for (HuntFinding& one : found) {
    const bool is_new = std::ranges::find(kept, one.traits, &HuntFinding::traits) == kept.end();
    if (is_new && kept.size() < most) kept.push_back(std::move(one));
  }
  for (HuntFinding& one : kept) one.gap = true_gap(one.simple.pair);
  return kept;
}

}  // namespace

std::vector<HuntFinding> findings(const Search& search, Subject& subject, std::size_t most,
                                  std::size_t answers) {
  const std::vector<Places> places = places_of(search);
  const std::size_t kinds = std::min(places.size(), most);
  std::vector<HuntFinding> all;
  for (std::size_t i = 0; i < kinds; ++i) {
    const std::size_t each = std::clamp<std::size_t>(most / kinds, 1, 3);
    std::ranges::move(of_a_kind(search, subject, places[i], each, answers),
                      std::back_inserter(all));
  }
  return all;
}

std::string pair_text(const EllipsoidPair& pair) {
  std::string text;
  const auto add = [&](const char* what, const auto& values) {
    text += what;
    for (const double v : values) text += ' ' + tables::to_text(v);
  };
  for (const RawEllipsoid* e : {&pair.a, &pair.b}) {
    add(e == &pair.a ? "  a  centre" : "  b  centre", e->centre);
    add("  semi-axes", e->semi_axes);
    add("  orientation", e->orientation);
    text += '\n';
  }
  return text;
}

std::string finding_text(const HuntFinding& finding, std::size_t number) {
  const Shrunk& simple = finding.simple;
  std::string text = "finding " + std::to_string(number) + ": " + finding.fault + " (" +
                     finding.traits + "), from " + finding.source + ", answer " +
                     std::to_string(finding.found) + '\n';
  if (!finding.again) {
    return text + "  asked again, the same pair has no such fault: the answers are not the same\n" +
           pair_text(finding.before);
  }
  text += pair_text(simple.pair);
  text += "  true: " + std::string(name(simple.verdict.truth)) +
          (finding.gap ? ", gap " + tables::to_text(*finding.gap) : ", a gap that is not proven");
  text += finding.asked ? "; answered: " + said_text(simple.answer) + '\n'
                        : "\n  not made simple: the hunt had to end\n";
  if (simple.verdict.error > 0) {
    text += "  error " + tables::rounded_text(simple.verdict.error, 3) + '\n';
  }
  return text;
}

std::vector<NamedPair> named(const std::vector<HuntFinding>& findings) {
  std::vector<NamedPair> rows;
  for (const HuntFinding& one : findings) {
    rows.push_back({family_name(one.fault),
                    one.traits + "; " + one.fault +
                        (one.asked ? "; answered " + said_text(one.simple.answer) : ""),
                    one.simple.pair});
  }
  return rows;
}

}  // namespace tangency::inline v0::verify
