// SPDX-License-Identifier: GPL-3.0-or-later
// Scores, isolation and tables, on made-up peers.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/peers/isolate.hpp>
#include <tangency/bench/peers/report.hpp>

namespace tangency::peers {
namespace {

std::optional<PeerContact> answer(double gap) { return PeerContact{gap < 0, gap, {}, {}}; }

TEST(Score, CountsWrongMissingAndGapsAndRanksErrorsInTheUnit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::optional<PeerContact>> answers;
  std::vector<Truth> truth;
  for (int i = 1; i <= 100; ++i) {  // errors of 1 ... 100 in units of 2
    answers.push_back(answer(1000.0 + 2 * i));
    truth.push_back({1000.0, 2.0});
  }
  Score s = score(answers, truth);
  EXPECT_EQ(s.pairs, 100u);
  EXPECT_EQ(s.gaps, 100u);
  EXPECT_EQ(s.wrong + s.unanswered, 0u);
  EXPECT_EQ(s.median, 50.0);
  EXPECT_EQ(s.percentile_99, 99.0);
  EXPECT_EQ(s.largest, 100.0);

  answers[0] = std::nullopt;
  answers[1] = PeerContact{true, {}, {}, {}};  // wrong, and no gap
  answers[2] = answer(-1);                     // wrong
  s = score(answers, truth);
  EXPECT_EQ(s.unanswered, 1u);
  EXPECT_EQ(s.wrong, 2u);
  EXPECT_EQ(s.gaps, 98u);
  EXPECT_EQ(s.largest, 500.5);

  answers[3] = PeerContact{false, nan, {}, {}};
  EXPECT_EQ(score(answers, truth).largest, std::numeric_limits<double>::infinity());
}

TEST(Score, OfNoGapsIsZeroErrors) {
  const std::vector<std::optional<PeerContact>> answers = {PeerContact{true, {}, {}, {}}};
  const Score s = score(answers, std::vector<Truth>{{-1, 1}});
  EXPECT_EQ(s.gaps, 0u);
  EXPECT_EQ(s.wrong, 0u);
  EXPECT_EQ(s.largest, 0.0);
}

class Scripted final : public PeerPair {
 public:
  explicit Scripted(Outcome outcome) : outcome_(outcome) {}
  std::optional<PeerContact> contact() override {
    switch (outcome_) {
      case Outcome::answered:
        return answer(-0.25);
      case Outcome::failed:
        return {};
      case Outcome::aborted:
        std::abort();
      case Outcome::hung:
        for (volatile bool stay = true; stay;) {
        }
    }
    return {};
  }

 private:
  Outcome outcome_;
};

TEST(Isolation, GoesOnAfterPairsThatEndOrHangTheProgram) {
  const std::vector<Outcome> script = {Outcome::aborted,  Outcome::answered, Outcome::hung,
                                       Outcome::aborted,  Outcome::failed,   Outcome::answered,
                                       Outcome::answered, Outcome::aborted};
  std::vector<std::unique_ptr<PeerPair>> pairs;
  for (const Outcome outcome : script) pairs.push_back(std::make_unique<Scripted>(outcome));
  const std::vector<Isolated> seen = ask_isolated(pairs);
  ASSERT_EQ(seen.size(), script.size());
  for (std::size_t i = 0; i < script.size(); ++i) {
    EXPECT_EQ(seen[i].outcome, script[i]) << i;
    EXPECT_EQ(seen[i].contact.has_value(), script[i] == Outcome::answered) << i;
    if (seen[i].contact) {
      EXPECT_EQ(seen[i].contact->gap, -0.25);
    }
  }
}

Row row(const char* call, GapOf gap_of, Definition definition) {
  Row r;
  r.family = "family";
  r.peer = {"Code", "1.2", call, "options", definition, gap_of};
  r.score.pairs = 10;
  r.score.wrong = 3;
  r.score.largest = 4e-15;
  r.ours_there = 2e-15;
  r.time = 6000;
  r.signed_gap = 400;
  return r;
}

TEST(Tables, PutEachRowUnderTheQuestionsItAnswers) {
  const std::string text = tables({row("yes", GapOf::none, Definition::common_normal),
                                   row("gap", GapOf::all, Definition::common_normal),
                                   row("depth", GapOf::overlapping, Definition::portal)},
                                  10.0);
  const auto count_in = [&](const std::string& what, const char* from, const char* to) {
    const std::size_t begin = text.find(from), end = text.find(to);
    EXPECT_NE(begin, std::string::npos) << from;
    int count = 0;
    for (std::size_t at = text.find(what, begin); at < end; at = text.find(what, at + 1)) ++count;
    return count;
  };
  const char* yes = "### Do the solids overlap?";
  const char* gap = "### Gap by the common normal";
  const char* portal = "### Depth of the last portal";
  for (const char* call : {"`yes`", "`gap`", "`depth`"}) EXPECT_EQ(count_in(call, yes, gap), 1);
  EXPECT_EQ(count_in("Code `yes`", gap, "no such text"), 0);
  EXPECT_EQ(count_in("Code `gap`", gap, portal), 1);
  EXPECT_EQ(count_in("Code `gap`", portal, "no such text"), 0);
  EXPECT_EQ(count_in("Code `depth`", gap, portal), 0);
  EXPECT_EQ(count_in("Code `depth`", portal, "no such text"), 1);
  EXPECT_EQ(count_in("| 6000 | 15.0 | 600.0 |", gap, "no such text"), 2);
}

TEST(AgainstSimbody, NamesTheRatioAndBothLargestErrorsOfItsOwnTrackerOnly) {
  Row batch = row(kBatchCall, GapOf::all, Definition::common_normal);
  batch.time = 40;
  Row of_another_family = batch;
  of_another_family.family = "another";
  EXPECT_EQ(against_simbody({row("other", GapOf::all, Definition::common_normal), batch,
                             of_another_family,
                             row(kSimbodyTracker, GapOf::overlapping, Definition::common_normal)}),
            "family: signed_gap 400 ns, Simbody's ConvexImplicitPair 6000 ns: 15.0 x as fast; "
            "largest error 2.0e-15 against 4.0e-15\n"
            "family: signed_gaps, options 40 ns, Simbody's ConvexImplicitPair 6000 ns: 150.0 x as "
            "fast; largest error 4.0e-15 against 4.0e-15\n");
}

}  // namespace
}  // namespace tangency::peers
