// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/findings.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
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

// Names, in the order of the search's archive, with fewest traits first.
std::map<std::string, std::vector<std::pair<std::uint16_t, const Elite*>>> by_fault(
    const Archive& archive) {
  std::map<std::string, std::vector<std::pair<std::uint16_t, const Elite*>>> all;
  for (const auto& [kind, elite] : archive) {
    if (!kind.first.empty()) all[kind.first].emplace_back(kind.second, &elite);
  }
  for (auto& [fault, places] : all) {
    std::ranges::stable_sort(places, {}, [](const auto& one) { return std::popcount(one.first); });
  }
  return all;
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

// What a corpus may call a family.
std::string family_name(std::string text) {
  for (char& c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != ' ') c = '-';
  }
  return text;
}

}  // namespace

std::vector<HuntFinding> findings(const Search& search, Subject& subject, std::size_t most,
                                  std::size_t answers) {
  // Chosen: after so many pairs whose simple forms are known already, others will be too.
  constexpr std::size_t kMostInVain = 4;
  std::vector<HuntFinding> all;
  for (const auto& [fault, places] : by_fault(search.archive())) {
    std::set<std::uint16_t> known;
    std::size_t in_vain = 0;
    for (const auto& [set, elite] : places) {
      if (known.size() == most || in_vain == kMostInVain) break;
      HuntFinding one{fault, elite->source, {}, elite->found, elite->pair, {}, true};
      one.simple = shrunk(subject, search.judge(), elite->pair, fault, answers);
      one.again = one.simple.verdict.fault == fault;
      const auto now = one.again ? traits(one.simple.pair, one.simple.verdict.near) : set;
      if (!known.insert(now).second) {
        ++in_vain;
        continue;
      }
      one.traits = names_of(now);
      all.push_back(std::move(one));
    }
    const auto of_this = all.end() - static_cast<std::ptrdiff_t>(known.size());
    std::stable_sort(of_this, all.end(), [](const HuntFinding& one, const HuntFinding& other) {
      return complexity(one.simple.pair) < complexity(other.simple.pair);
    });
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
  const bool touch = simple.verdict.truth == Relation::external_touch;
  text += "  true: " + std::string(name(simple.verdict.truth)) +
          (touch ? "" : ", gap about " + tables::rounded_text(simple.verdict.near.gap, 6)) +
          "; answered: " + said_text(simple.answer) + '\n';
  if (simple.verdict.error > 0) {
    text += "  error " + tables::rounded_text(simple.verdict.error, 3) + '\n';
  }
  return text;
}

CorpusText findings_corpus(const std::vector<HuntFinding>& findings, const std::string& comment) {
  std::vector<NamedPair> rows;
  for (const HuntFinding& one : findings) {
    rows.push_back({family_name(one.fault),
                    one.traits + "; " + one.fault + "; answered " + said_text(one.simple.answer),
                    one.simple.pair});
  }
  return corpus_of(rows, comment);
}

}  // namespace tangency::inline v0::verify
