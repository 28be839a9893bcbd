// SPDX-License-Identifier: GPL-3.0-or-later
// Isolation and tables, on made-up peers.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/peers/isolate.hpp>
#include <tangency/bench/peers/report.hpp>

namespace tangency::peers {
namespace {

std::optional<PeerContact> answer(double gap) { return PeerContact{gap < 0, gap, {}, {}}; }

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
  r.grade.pairs = 10;
  r.grade.wrong = 3;
  r.grade.gap.largest = 4e-15;
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
