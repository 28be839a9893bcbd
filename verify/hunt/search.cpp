// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/search.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>

namespace tangency::inline v0::verify {
namespace {

// Chosen: a slow tool is not kept for long, and a fast one is not started for a handful.
constexpr std::size_t kFirst = 16, kLargest = 512;
// Chosen: to begin a family may cost a thousand of its pairs, so that each is begun once in so many
// generations, for so many pairs.
constexpr std::size_t kEpoch = 256;
constexpr int kDrawn = 100;
constexpr const char* kFormat = "tangency-verify hunt 1";

// SplitMix64: neighbouring seeds and generations have nothing in common.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15 * (number + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

// FNV-1a: a family is known by its name, wherever it stands.
std::uint64_t fnv(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

template <class Values>
const auto& one_of(Draw& draw, const Values& values) {
  return values[static_cast<std::size_t>(draw.integer(0, static_cast<int>(values.size()) - 1))];
}

nlohmann::json as_json(const std::pair<std::string, std::uint16_t>& kind, const Elite& elite) {
  const auto& [normal, gap, size] = elite.near;
  return {{"fault", kind.first},         {"traits", kind.second},
          {"pair", numbers(elite.pair)}, {"source", elite.source},
          {"badness", elite.badness},    {"error", elite.error},
          {"found", elite.found},        {"near", {normal[0], normal[1], normal[2], gap, size}}};
}

Elite elite_of(const nlohmann::json& one) {
  const auto near = one.at("near").get<std::array<double, 5>>();
  return {pair_of(one.at("pair").get<std::array<double, 20>>()),
          one.at("source").get<std::string>(),
          one.at("badness").get<double>(),
          one.at("error").get<double>(),
          one.at("found").get<std::size_t>(),
          {{near[0], near[1], near[2]}, near[3], near[4]}};
}

}  // namespace

std::array<double, 20> numbers(const EllipsoidPair& pair) {
  std::array<double, 20> all{};
  auto out = all.begin();
  for (const RawEllipsoid* e : {&pair.a, &pair.b}) {
    out = std::ranges::copy(e->centre, out).out;
    out = std::ranges::copy(e->semi_axes, out).out;
    out = std::ranges::copy(e->orientation, out).out;
  }
  return all;
}

EllipsoidPair pair_of(const std::array<double, 20>& n) {
  return {{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8], n[9]}},
          {{n[10], n[11], n[12]}, {n[13], n[14], n[15]}, {n[16], n[17], n[18], n[19]}}};
}

Search::Search(Judge& judge, std::vector<Source> sources, std::uint64_t seed)
    : judge_(judge), sources_(std::move(sources)), seed_(seed) {
  assert(!sources_.empty());
}

Search::Candidate Search::fresh(Draw& draw) {
  const Source& source = one_of(draw, sources_);
  const bool row = source.families.empty() || (!source.rows.empty() && draw.coin());
  if (row) return {one_of(draw, source.rows), source.name};
  const auto& family = one_of(draw, source.families);
  Drawn& drawn = drawn_[&family];
  const std::size_t epoch = generation_ / kEpoch;
  if (!drawn.next || drawn.epoch != epoch) {
    drawn = {epoch, family.sequence(mixed(seed_ + epoch, fnv(source.name + family.name))), {}};
  }
  const auto place = static_cast<std::size_t>(draw.integer(0, kDrawn - 1));
  while (drawn.pairs.size() <= place) drawn.pairs.push_back(drawn.next());
  return {drawn.pairs[place], source.name};
}

// One to three moves from one of the archive, wrong or right by chance.
Search::Candidate Search::moved(Draw& draw) const {
  const bool from_wrong = !wrong_.empty() && (right_.empty() || draw.integer(0, 2) == 0);
  const Elite& elite = *one_of(draw, from_wrong ? wrong_ : right_);
  Candidate candidate{elite.pair, elite.source};
  const int count = draw.integer(1, 3);
  for (int i = 0; i < count; ++i) {
    EllipsoidPair next = candidate.pair;
    one_of(draw, moves()).change(draw, next, elite.near);
    if (is_fair(next)) candidate.pair = next;
  }
  // Half of them end near a touch, where a code has most to lose: the moves before have led away.
  if (draw.coin()) {
    EllipsoidPair next = candidate.pair;
    moves().front().change(draw, next, nearness(gap_bracket(next.a, next.b)));
    if (is_fair(next)) candidate.pair = next;
  }
  return candidate;
}

std::vector<Search::Candidate> Search::generation() {
  Draw draw(mixed(seed_, generation_));
  std::vector<Candidate> all(generation_ < 5 ? kFirst << generation_ : kLargest);
  for (Candidate& one : all) {
    const bool starts = (right_.empty() && wrong_.empty()) || draw.integer(0, 15) == 0;
    one = starts ? fresh(draw) : moved(draw);
  }
  return all;
}

void Search::take(const Candidate& candidate, const Verdict& verdict) {
  ++answers_;
  open_ += verdict.open;
  if (!verdict.fault.empty()) {
    FaultCount& count = faults_[verdict.fault];
    if (count.count++ == 0) count.first = answers_;
  }
  not_claimed_ += verdict.not_claimed;
  // Nothing is known of an open answer, and those near it cost as much and say as little.
  if (verdict.open || verdict.not_claimed) return;
  const std::pair kind{verdict.fault, traits(candidate.pair, verdict.near)};
  const auto found = archive_.find(kind);
  // A right answer as bad as the one before takes its place, so that the search moves on.
  const bool worse = found == archive_.end() || verdict.badness > found->second.badness ||
                     (verdict.fault.empty() && verdict.badness == found->second.badness);
  if (!worse) return;
  archive_[kind] = {candidate.pair, candidate.source, verdict.badness,
                    verdict.error,  answers_,         verdict.near};
}

void Search::refresh_picks() {
  right_.clear(), wrong_.clear();
  for (const auto& [kind, elite] : archive_) {
    (kind.first.empty() ? right_ : wrong_).push_back(&elite);
  }
}

bool Search::step(Subject& subject, std::size_t most) {
  std::vector<Candidate> candidates = generation();
  const std::size_t whole = candidates.size();
  candidates.resize(std::min(most, whole));
  std::vector<EllipsoidPair> pairs;
  for (const Candidate& one : candidates) pairs.push_back(one.pair);
  const Answers answers = subject.answers(pairs);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    take(candidates[i], judge_.verdict(pairs[i], answers[i]));
  }
  refresh_picks();
  ++generation_;
  return answers.size() == whole;
}

std::string Search::saved(const std::string& question) const {
  nlohmann::json state{{"format", kFormat},
                       {"question", question},
                       {"generation", generation_},
                       {"answers", answers_},
                       {"open", open_},
                       {"not claimed", not_claimed_},
                       {"faults", nlohmann::json::object()},
                       {"archive", nlohmann::json::array()}};
  for (const auto& [name, fault] : faults_) state["faults"][name] = {fault.count, fault.first};
  for (const auto& [kind, elite] : archive_) state["archive"].push_back(as_json(kind, elite));
  return state.dump(1) + '\n';
}

std::string Search::resume(const std::string& text, const std::string& question) {
  try {
    const nlohmann::json state = nlohmann::json::parse(text);
    if (state.at("format") != kFormat) return "this is no state of a hunt";
    if (state.at("question") != question) {
      return "this is the state of another hunt: " + state.at("question").get<std::string>();
    }
    generation_ = state.at("generation").get<std::size_t>();
    answers_ = state.at("answers").get<std::size_t>();
    open_ = state.value("open", std::size_t{0});
    not_claimed_ = state.value("not claimed", std::size_t{0});
    for (const auto& [name, fault] : state.at("faults").items()) {
      faults_[name] = {fault.at(0).get<std::size_t>(), fault.at(1).get<std::size_t>()};
    }
    for (const nlohmann::json& one : state.at("archive")) {
      archive_[{one.at("fault").get<std::string>(), one.at("traits").get<std::uint16_t>()}] =
          elite_of(one);
    }
  } catch (const nlohmann::json::exception&) {
    return "this is no state of a hunt";
  }
  refresh_picks();
  return {};
}

}  // namespace tangency::inline v0::verify
