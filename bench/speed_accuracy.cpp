// SPDX-License-Identifier: GPL-3.0-or-later
// Speed against accuracy: every method, option and number of steps on families of pairs whose
// truth the 100-digit oracle knows. Answers are checked before anything is timed; where a method
// that promises no wrong answer has one, the program names the pair and ends with status 1.
// docs/speed-accuracy.md says how it was run and what came out.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <tangency/bench/pairs.hpp>
#include <tangency/bench/speed_accuracy/count.hpp>
#include <tangency/bench/speed_accuracy/methods.hpp>
#include <tangency/bench/speed_accuracy/overlaps_first.hpp>
#include <tangency/bench/speed_accuracy/report.hpp>
#include <tangency/bench/timing.hpp>
#include <tangency/geometry/tables/command_line.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace {

using namespace tangency::speed_accuracy;
using namespace tangency::bench;

// Callgrind is some fifty times slower: instructions are those of four blocks of the batch.
constexpr std::size_t kCounted = 256;

struct Options {
  std::vector<std::string> families;
  std::size_t pairs = 1000;  ///< of a family
  int rounds = 25;
  bool quick = false, count = false;
  bool counted = false;  ///< this is the run under valgrind
  std::string csv, json, ahead, markdown, picture;

  std::size_t counted_pairs() const { return std::min(pairs, kCounted); }
  Effort effort() const { return quick ? Effort{3, 1e-4, 0.01} : Effort{rounds, 1e-3, 0.5}; }
};

void say(const std::string& what) {
  static const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start;
  std::fprintf(stderr, "%6.1f s  %s\n", since.count(), what.c_str());
}

/// A family with all that is asked about it.
struct Subject {
  std::unique_ptr<Pairs> pairs;
  std::vector<Method> methods;
};

void print_pair(const Pairs& pairs, std::size_t i) {
  for (const auto* e : {&pairs.raw[2 * i], &pairs.raw[2 * i + 1]}) {
    for (const double x : e->centre) std::fprintf(stderr, "%a,", x);
    for (const double x : e->semi_axes) std::fprintf(stderr, "%a,", x);
    for (const double x : e->orientation) std::fprintf(stderr, "%a,", x);
  }
  std::fprintf(stderr, "\n");
}

Row row_of(const Pairs& pairs, const Method& method) {
  Row row;
  row.family = pairs.name;
  row.method = method.name;
  row.option = method.option;
  row.steps = method.steps;
  row.level = level_name(method.level);
  row.definition = to_string(method.definition);
  return row;
}

/// Asks the oracle, by as many threads as there are processors.
void find_truth(Pairs& pairs) {
  pairs.truth.resize(pairs.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < pairs.size(); i = next++) pairs.truth[i] = truth_of(pairs, i);
  };
  std::vector<std::jthread> pool;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) pool.emplace_back(work);
  work();
  pool.clear();  // waits for all
}

void count_left(const Pairs& pairs, const std::vector<std::size_t>& left, Row& row) {
  row.left = left.size();
  row.left_deep = static_cast<std::size_t>(std::ranges::count_if(left, [&](std::size_t i) {
    const double rho = pairs.a(i).least_radius() + pairs.b(i).least_radius();
    return pairs.truth[i].gap.high < -rho;
  }));
}

/// Asks every method. False where one breaks its promise.
bool check(Subject& subject, std::vector<Row>& rows) {
  bool right = true;
  for (const Method& method : subject.methods) {
    Row row = row_of(*subject.pairs, method);
    force_level(method.level);
    method.run();
    row.grade = tangency::verify::grade_calls(method.answers(), subject.pairs->truth);
    if (method.left) count_left(*subject.pairs, method.left(), row);
    force_level(0);
    if (method.promises && row.grade.wrong > 0) {
      std::fprintf(stderr, "%s: %zu wrong answers, the first for pair %zu: ", row.key().c_str(),
                   row.grade.wrong, row.grade.first_wrong);
      print_pair(*subject.pairs, row.grade.first_wrong);
      right = false;
    }
    rows.push_back(row);
  }
  return right;
}

std::vector<Subject> make_subjects(const Options& options) {
  const auto levels = best_levels();
  std::vector<Subject> subjects;
  for (const std::string& family : options.families) {
    Subject subject;
    subject.pairs = drawn_pairs(family, options.counted ? options.counted_pairs() : options.pairs);
    subject.methods = methods_on(*subject.pairs, levels);
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

/// The run under valgrind.
int count_all(const Options& options) {
  for (const Subject& subject : make_subjects(options)) {
    say("counting " + subject.pairs->name);
    for (const Method& method : subject.methods) {
      force_level(method.level);
      count_row(row_of(*subject.pairs, method).key(), method.run);
      force_level(0);
    }
  }
  return 0;
}

void add_instructions(const Options& options, std::vector<Row>& rows) {
  std::vector<std::string> arguments = {"--counted", "--pairs", std::to_string(options.pairs)};
  for (const std::string& family : options.families)
    arguments.insert(arguments.end(), {"--families", family});
  const auto counts = count_by_valgrind(arguments);
  const auto pairs = static_cast<double>(options.counted_pairs());
  for (Row& row : rows) {
    const auto found = counts.find(row.key());
    if (found != counts.end()) row.instructions = found->second / pairs;
  }
}

void time_all(const Options& options, const std::vector<Subject>& subjects,
              std::vector<Row>& rows) {
  auto row = rows.begin();
  double inverse = std::numeric_limits<double>::infinity();
  for (const Subject& subject : subjects) {
    say("timing " + subject.pairs->name);
    std::vector<Job> jobs = {inverse_job()};
    for (const Method& method : subject.methods)
      jobs.push_back({method.run, subject.pairs->size(), method.level});
    time_by_turns(jobs, options.effort());
    inverse = std::min(inverse, jobs[0].least);
    for (std::size_t i = 1; i < jobs.size(); ++i) (row++)->ns = jobs[i].least;
  }
  for (Row& r : rows) r.inverse = inverse;
}

/// The yes/no question ahead of the contact. False where an answer is wrong.
bool run_ahead(const Options& options, std::vector<AheadRow>& rows) {
  const auto levels = best_levels();
  for (const char* family : {"class1", "class2"}) {
    for (const int touching : kTouchingShares) {
      say(std::string("yes or no first, ") + family + ", " + std::to_string(touching) +
          " % touching");
      const std::unique_ptr<Pairs> pairs = listed_pairs(family, touching, options.pairs);
      std::vector<Job> jobs;
      const std::vector<Ahead> ways = ways_to_contacts(*pairs, levels);
      for (const Ahead& way : ways) {
        force_level(way.level);
        way.all();
        way.asked();
        force_level(0);
        if (!way.right()) {
          std::fprintf(stderr, "%s, %s: wrong contacts: no timing\n", way.method.c_str(), family);
          return false;
        }
        jobs.push_back({way.all, pairs->size(), way.level});
        jobs.push_back({way.asked, pairs->size(), way.level});
      }
      time_by_turns(jobs, options.effort());
      for (std::size_t i = 0; i < ways.size(); ++i) {
        rows.push_back({family, ways[i].method, level_name(ways[i].level), touching,
                        jobs[2 * i].least, jobs[2 * i + 1].least});
      }
    }
  }
  return true;
}

void write(const std::string& path, const std::string& text) {
  if (path.empty()) return;
  tangency::tables::OutputFile file(path);
  file.write(text);
  file.commit();
}

int run(const Options& options) {
  std::vector<Subject> subjects = make_subjects(options);
  std::vector<Row> rows;
  bool right = true;
  for (Subject& subject : subjects) {
    say("truth of " + subject.pairs->name);
    find_truth(*subject.pairs);
    right = check(subject, rows) && right;
  }
  if (!right) return 1;
  std::vector<AheadRow> ahead;
  time_all(options, subjects, rows);
  if (!run_ahead(options, ahead)) return 1;
  if (options.count) add_instructions(options, rows);
  const std::string table = to_csv(rows), ahead_table = to_csv(ahead);
  write(options.csv, table);
  write(options.json, to_json(rows));
  write(options.ahead, ahead_table);
  if (!options.picture.empty()) write(options.picture, to_picture(table));
  const bool silent = options.csv.empty() && options.json.empty() && options.markdown.empty();
  if (silent) std::fputs(to_markdown(table, ahead_table).c_str(), stdout);
  if (!options.markdown.empty()) write(options.markdown, to_markdown(table, ahead_table));
  say("done");
  return 0;
}

/// Those whose name contains one of the texts.
std::vector<std::string> chosen_families(const std::vector<std::string>& texts) {
  std::vector<std::string> chosen = family_names();
  if (texts.empty()) return chosen;
  std::erase_if(chosen, [&](const std::string& name) {
    return std::none_of(texts.begin(), texts.end(), [&](const std::string& text) {
      return name.find(text) != std::string::npos;
    });
  });
  return chosen;
}

std::string footer() {
  std::string text = "Families:\n";
  for (const std::string& name : family_names()) text += "  " + name + "\n";
  return text + "Columns of CSV and JSON:\n" + describe_columns();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::vector<std::string> texts;
  tangency::tables::Program program("bench_speed_accuracy",
                                    "Error against time of every way to the gap of two ellipsoids");
  program.option("--families", texts, "families whose name contains one of these; else all");
  program.option("--pairs", options.pairs, "of each family")
      .between(std::size_t{1}, std::size_t{1000000})
      .shows_default();
  program.option("--rounds", options.rounds, "in each of which everything is timed once")
      .between(1, 1000)
      .shows_default();
  program.flag("--quick", options.quick, "40 pairs of each, a few short rounds: a try, no figures");
  program.flag("--count", options.count, "count instructions, by valgrind");
  program.flag("--counted", options.counted).hidden();
  program.option("--csv", options.csv, "write the table here");
  program.option("--json", options.json, "the same as an array of objects");
  program.option("--ahead", options.ahead, "CSV of the yes/no question ahead of the contact");
  program.option("--markdown", options.markdown, "short tables; to standard output by default");
  program.option("--picture", options.picture, "SVG of error against time, drawn by gnuplot");
  program.footer(footer());
  program.runs([&] {
    if (options.quick) options.pairs = 40;
    options.families = chosen_families(texts);
    if (options.families.empty()) {
      throw tangency::tables::UsageError("--families: no family has such a name");
    }
    if (options.count && !can_count()) {
      throw tangency::tables::UsageError("--count: not built with <valgrind/callgrind.h>");
    }
    return options.counted ? count_all(options) : run(options);
  });
  return program.run(argc, argv);
}
