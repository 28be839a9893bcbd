// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/tests/fuzz/mutate.hpp>
#include <tangency/tests/fuzz/target.hpp>
#include <tangency/verify/answers/truth_table.hpp>
#include <tangency/verify/grade/grade.hpp>
#include <tangency/verify/grade/outputs.hpp>

namespace tangency::testing::fuzz {
namespace {

using namespace verify;

// One of each kind. An input of `answers` begins with a byte that says which.
constexpr std::array<const char*, 10> kCorpora{"near",     "nested",    "ellipses", "quadrics",
                                               "points",   "walls",     "rays",     "times",
                                               "matrices", "neighbours"};
constexpr std::size_t kLines = 40;

std::string truth_text(const char* corpus) {
  return source_file("verify/corpora/" + std::string(corpus) + ".truth.csv", kLines);
}

tables::NamedText named(const std::string& text) { return {"table.csv", text}; }

const TruthTable& truth_of(std::size_t corpus) {
  static const std::vector<TruthTable> all = [] {
    std::vector<TruthTable> list;
    for (const char* name : kCorpora) {
      const std::string text = truth_text(name);
      list.push_back(read_truth(tables::Reader(named(text)), Definition::common_normal));
    }
    return list;
  }();
  return all[corpus];
}

void hold_grade(const std::string& target, const TruthTable& truth, const Grade& grade) {
  const FamilyGrade& all = grade.all;
  const auto hold = [&](bool holds, const char* what) { require(holds, target, what); };
  const bool is_list = truth.kind == CorpusKind::neighbours;
  hold(all.rows <= truth.rows.size(), "rows");
  hold(is_list || (all.wrong <= all.rows && all.unanswered <= all.rows), "counts of rows");
  hold(grade.faults.size() <= std::min<std::size_t>(10, grade.fault_count), "faults");
  hold(std::ranges::is_sorted(grade.findings, {}, &Finding::row), "the order of findings");
  std::size_t wrong = 0;
  for (const FamilyGrade& family : grade.families) wrong += family.wrong;
  hold(wrong == all.wrong, "wrong answers of families");
  for (const std::string& fault : grade.faults)
    hold(std::ranges::none_of(fault,
                              [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); }),
         "a fault is one line");
}

/// Every output of a grade is made, whatever stands in the answers.
void write_outputs(const std::string& target, const TruthTable& truth, const Grade& grade) {
  GradeReport report;
  report.title = "answers.csv";
  report.date = "2026-12-01T00:00:00";
  const CorpusReport& corpus = add(report, {"corpus", truth.kind, grade, std::nullopt, {}});
  const std::string table = as_table(corpus);
  judge(report, {});
  const bool failed = grade.all.wrong > 0 || grade.all.missing > 0;
  require(!(failed && report.has_passed()), target, "a grade with faults that has passed");
  std::size_t bytes = table.size();
  for (const auto output :
       {as_json, as_json_summary, as_junit, as_sarif, as_markdown, as_annotations, as_page})
    bytes += output(report).size();
  count("bytes of outputs", bytes);
}

void run_answers(Bytes input) {
  if (input.empty()) return;
  const TruthTable& truth = truth_of(input[0] % kCorpora.size());
  const std::string text(input.begin() + 1, input.end());
  Demands demands;
  demands.words = input[0] >= 128;
  const Grade graded = grade(truth, named(text), demands);
  hold_grade("answers", truth, graded);
  write_outputs("answers", truth, graded);
  count(graded.fault_count == 0 ? "without faults" : "with faults");
}

/// The byte stays, or becomes another.
std::size_t mutate_answers(std::uint8_t* data, std::size_t size, std::size_t most,
                           std::uint64_t seed) {
  std::uint64_t state = seed;
  if (size == 0 || below(state, 50) == 0) return mutate_bytes(data, size, most, next(state));
  return 1 + mutate_text(data + 1, size - 1, most - 1, next(state));
}

std::vector<std::string> answer_seeds() {
  std::vector<std::string> seeds;
  for (std::size_t k = 0; k < kCorpora.size(); ++k) {
    // A table of truth has the columns that answers have, and others, which are none.
    seeds.push_back(static_cast<char>(k) + truth_text(kCorpora[k]));
  }
  seeds.emplace_back(
      "\x80"
      "row,relation,gap,nx,ny,nz,gap_error,status\n"
      "0,separate,0.5,1,0,0,1e-9,ok\n1,overlap,-0.5,0,1,0,1e-9,local\n");
  return seeds;
}

void run_truth(Bytes input) {
  const std::string text(input.begin(), input.end());
  constexpr std::array kDefinitions{Definition::common_normal, Definition::perram_wertheim,
                                    Definition::midpoint_potential, Definition::centre_line};
  try {
    const Definition definition = kDefinitions[hash_of(input) % kDefinitions.size()];
    const TruthTable truth = read_truth(tables::Reader(named(text)), definition);
    std::size_t normals = 0, neighbours = 0;
    for (const TruthRow& row : truth.rows) {
      require(row.family < truth.families.size(), "truth", "a family");
      normals += row.normals;
      neighbours += row.neighbours;
    }
    require(normals <= truth.maximisers.size() && neighbours <= truth.neighbours.size(), "truth",
            "normals and neighbours");
    constexpr int kMostEdges = 1000000;
    for (const TrueNeighbour& one : truth.neighbours)
      for (const int edges : one.image)
        require(edges >= -kMostEdges && edges <= kMostEdges, "truth", "an image");
    // The truth as answers to itself.
    hold_grade("truth", truth, grade(truth, named(text), Demands()));
    count("read");
  } catch (const tables::Error& error) {
    require(std::string_view(error.what()).starts_with("table.csv"), "truth", error.what());
    count("refused");
  }
}

std::vector<std::string> truth_seeds() {
  std::vector<std::string> seeds;
  for (const char* corpus : kCorpora) seeds.push_back(truth_text(corpus));
  return seeds;
}

}  // namespace

std::vector<Target> grader_targets() {
  constexpr std::size_t kMostBytes = 16384;
  return {{"answers", "any text as answers, graded, and every output of the grade", kMostBytes,
           answer_seeds, run_answers, mutate_answers},
          {"truth", "any text as the truth of a corpus", kMostBytes, truth_seeds, run_truth,
           mutate_text}};
}

}  // namespace tangency::testing::fuzz
