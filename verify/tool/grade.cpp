// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/verify/answers/tool_run.hpp>
#include <tangency/verify/grade/baseline.hpp>
#include <tangency/verify/grade/report.hpp>
#include <tangency/verify/tool/command_line.hpp>

namespace tangency::inline v0::verify {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTruthSuffix = ".truth.csv";

constexpr const char* kHelp = R"(
What is graded is a table with the column row, the number of the input row from 0, and
any of these; what its header names is asked of every row:
  relation     separate, external_touch, overlap, internal_touch, a_in_b, b_in_a, equal
  overlaps     0 or 1: do the interiors meet
  gap          signed; and gap_error, a bound on its error that is claimed to hold (of a
               row with the status local: for a local gap, the true one is not below
               gap - gap_error)
  nx ny nz     unit normal from a to b; of ellipses nx ny
  crossings, area   of ellipses
  type         of quadrics
A tool gets the inputs on standard input, a table without comment lines whose numbers are
hex floats, in the columns of `tangency contact`, `ellipse` or `classify`.

The grade, family by family:
  wrong        answers that differ from the exact relation, crossings or type
  touches      overlaps 1 on an external touch: counted here and never as wrong
  missing      rows without a whole answer, cells that are no number included
  broken       rows whose error is above their gap_error
  reversed     normals more than 90 degrees from every true one: those from b to a
  gap error    |gap - truth| / L, L the distance of the centres and both largest semi-axes
  normal error length of the difference to the nearest true normal
  area error   |area - truth| / area of the smaller ellipse
  with median, 99 %, largest and the row of the largest; then rows that are answered twice,
  that the corpus does not have, or that cannot be read.

The last line is the verdict, `passed: ` or `FAILED: ` and the totals over all corpora; every
reason to fail has a line before it.

Exit status: 0 every row answered, none wrong, every threshold kept; 1 answers are wrong,
missing, faulty or beyond a threshold, worse than the baseline, a claimed bound is broken, a
normal is reversed, or the tool was ended by a signal, hung or printed without end (its own
exit status is shown and decides nothing); 2 refused command line or corpus, or a failed
write.

Example:
  $ tangency-verify grade --tool 'tangency contact' --max-gap-error 1e-15
)";

struct Options {
  std::string answers, tool, corpora, json, html, baseline;
  std::string definition = "common-normal";
  std::vector<std::string> names;
  Thresholds thresholds;
  bool demands_words = false;
  double slack = 0;
  double seconds = 300;  // chosen: a thousand times what a corpus takes
};

[[noreturn]] void refuse(const std::string& file, const std::string& rule) {
  throw tables::Error({.file = file, .rule = rule});
}

// Beside the installed tool, or in the source tree.
fs::path default_corpora() {
  std::error_code unknown;
  const fs::path folder = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  const fs::path installed = (folder / TANGENCY_INSTALLED_CORPORA).lexically_normal();
  if (!unknown && fs::is_directory(installed, unknown)) return installed;
  return (folder / TANGENCY_SOURCE_CORPORA).lexically_normal();
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::error_code problem;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with(kTruthSuffix)) {
      names.push_back(file.substr(0, file.size() - kTruthSuffix.size()));
    }
  }
  if (problem) refuse(folder.string(), "cannot be read: " + problem.message());
  std::ranges::sort(names);
  return names;
}

std::string truth_of(const fs::path& folder, const std::string& name) {
  return (folder / (name + std::string(kTruthSuffix))).string();
}

std::vector<std::string> chosen_corpora(const Options& options, const fs::path& folder) {
  const std::vector<std::string> all = names_in(folder);
  for (const std::string& name : options.names) {
    if (std::ranges::count(options.names, name) > 1) {
      refuse("--corpus", name + " is named more than once");
    }
    if (std::ranges::find(all, name) != all.end()) continue;
    std::string rule = "there is no corpus " + name + " here; there are:";
    for (const std::string& known : all) rule += ' ' + known;
    refuse(folder.string(), rule);
  }
  if (!options.names.empty()) return options.names;
  std::vector<std::string> pairs = all;
  std::erase_if(pairs, [&](const std::string& name) {
    return kind_of_truth(truth_of(folder, name)) != CorpusKind::pairs;
  });
  if (pairs.empty()) refuse(folder.string(), "there is no corpus of pairs here");
  return pairs;
}

constexpr std::array<std::pair<std::string_view, Definition>, 4> kDefinitions{
    {{"common-normal", Definition::common_normal},
     {"perram-wertheim", Definition::perram_wertheim},
     {"midpoint-potential", Definition::midpoint_potential},
     {"centre-line", Definition::centre_line}}};

Definition definition_named(std::string_view name) {
  return std::ranges::find(kDefinitions, name, &std::pair<std::string_view, Definition>::first)
      ->second;
}

void require_readable(const std::string& path) {
  if (path == "-") return;
  std::error_code none;
  const int problem = ::access(path.c_str(), R_OK) != 0 ? errno
                      : fs::is_directory(path, none)    ? EISDIR
                                                        : 0;
  if (problem != 0) refuse(path, "cannot be read: " + std::generic_category().message(problem));
}

// The inputs must be those that the truth is about.
void require_rows(const std::string& inputs, std::size_t rows) {
  tables::Reader reader(inputs);
  std::size_t found = 0;
  tables::for_each_row(reader, [&](const tables::RowCursor&) { ++found; });
  if (found != rows) {
    refuse(inputs,
           std::to_string(found) + " rows: the truth beside it is of " + std::to_string(rows));
  }
}

CorpusGrade graded(const Options& options, const fs::path& folder, const std::string& name) {
  const TruthTable truth = read_truth(truth_of(folder, name), definition_named(options.definition));
  if (truth.rows.empty()) refuse(truth_of(folder, name), "a corpus must have rows");
  const Thresholds& limits = options.thresholds;
  const Demands demands{options.demands_words, limits.gap_error.has_value(),
                        limits.normal_error.has_value() && truth.has_normals};
  if (options.tool.empty()) {
    require_readable(options.answers);
    return {name, truth.kind, grade(truth, options.answers, demands), std::nullopt};
  }
  // Chosen: ten times the longest answer `tangency contact` can give, and a screen of messages.
  const std::size_t most_bytes = (std::size_t{1} << 16) + 4096 * truth.rows.size();
  const std::string inputs = (folder / (name + ".csv")).string();
  require_rows(inputs, truth.rows.size());
  const ToolRun run = run_tool(options.tool, inputs, {options.seconds, most_bytes});
  return {name, truth.kind, grade(truth, run.output_path, demands),
          RunNote{run.sound, run.ending, run.last_words, run.seconds}};
}

std::unique_ptr<tables::OutputFile> opened(const std::string& path) {
  return path.empty() ? nullptr : std::make_unique<tables::OutputFile>(path);
}

void write(const std::unique_ptr<tables::OutputFile>& file, const std::string& text) {
  if (!file) return;
  file->write(text);
  file->commit();
}

// The first of them; of the others how many there are.
void append_named(std::vector<std::string>& lines, const std::string& what,
                  const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;  // chosen: a screen
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) lines.push_back(what + names[i]);
  if (names.size() > kMost) {
    lines.push_back(what + "and " + std::to_string(names.size() - kMost) + " more");
  }
}

// What a baseline shows but for what fails.
std::string differences(const Comparison& beside, const std::string& file) {
  std::vector<std::string> lines;
  append_named(lines, "for information: ", beside.information);
  append_named(lines, "BETTER ", beside.better);
  append_named(lines, "NEW ", beside.unknown);
  if (!beside.better.empty() || !beside.unknown.empty()) {
    lines.push_back(std::to_string(beside.better.size()) + " values are better than in " + file +
                    " and " + std::to_string(beside.unknown.size()) +
                    " are not there; to hold later grades to them, run this again with --json " +
                    file + " added");
  }
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

ExitStatus run(const Options& options) {
  const fs::path folder = options.corpora.empty() ? default_corpora() : fs::path(options.corpora);
  const Baseline baseline = options.baseline.empty() ? Baseline() : read_baseline(options.baseline);
  // What cannot be written is refused before the first tool is started.
  const auto json = opened(options.json), html = opened(options.html);
  tables::OutputFile screen("-");
  std::vector<CorpusGrade> grades;
  for (const std::string& name : chosen_corpora(options, folder)) {
    grades.push_back(graded(options, folder, name));
    screen.write(as_table(grades.back()) + '\n');
  }
  std::vector<std::string> failed_by = failures(grades, options.thresholds);
  if (!options.baseline.empty()) {
    const Comparison beside = compare(grades, baseline, options.slack);
    screen.write(differences(beside, options.baseline));
    append_named(failed_by, "worse than the baseline: ", beside.worse);
  }
  for (const std::string& line : failed_by) screen.write("FAILED " + line + '\n');
  const std::string judged = verdict(grades, options.thresholds, failed_by.empty());
  write(json, as_json(grades));
  write(html,
        as_page(grades, options.tool.empty() ? options.answers : options.tool, failed_by, judged));
  screen.write(judged + '\n');
  return failed_by.empty() ? passed : failed;
}

std::vector<std::string> definition_names() {
  std::vector<std::string> names;
  for (const auto& [name, definition] : kDefinitions) names.emplace_back(name);
  return names;
}

std::string check_whole_number(const std::string& text) {
  std::size_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem == std::errc() && end == text.data() + text.size() &&
      (text == "0" || !text.starts_with('0')))
    return {};
  return text + " is not a whole number from 0";
}

// A finite number from 0; 0 itself only if asked for.
tables::Check number(bool or_zero) {
  return [or_zero](const std::string& text) -> std::string {
    double value = 0;
    if (!tables::parse_number(text, value) && (or_zero ? value >= 0 : value > 0)) return {};
    return text + " is not a finite number " + (or_zero ? ">= 0" : "> 0");
  };
}

void require_fitting(const Options& options) {
  if (options.tool.empty() == options.answers.empty()) {
    throw tables::UsageError("either --answers or --tool is required");
  }
  if (!options.answers.empty() && options.names.size() != 1) {
    throw tables::UsageError("one --corpus, which the answers are for, is required");
  }
}

}  // namespace

void add_grade(tables::Program& program) {
  const auto options = std::make_shared<Options>();
  tables::Command& command =
      program.subcommand("grade", "Grades answers, or a tool that gives them");
  command
      .option("--answers", options->answers,
              "A table of answers to one corpus; - is standard input")
      .not_empty()
      .type_name("FILE");
  command
      .option("--tool", options->tool,
              "A shell command, started once a corpus: inputs come on its standard input, "
              "answers are read from its standard output")
      .not_empty("command")
      .type_name("COMMAND");
  command
      .option("--corpus", options->names,
              "Which; several for a tool (default: all corpora of pairs of ellipsoids)")
      .type_name("NAME");
  command
      .option("--corpora", options->corpora,
              "Folder of NAME.csv and NAME.truth.csv (default: that of this program)")
      .not_empty()
      .type_name("DIR");
  command
      .option(
          "--definition", options->definition,
          "What gap and normal mean (default: common-normal); centre-line: how far B moves along "
          "the line of centres until both touch, and normals are not graded")
      .one_of(definition_names());
  Thresholds& limits = options->thresholds;
  const tables::Option max_wrong =
      command
          .option("--max-wrong", limits.wrong,
                  "Most wrong answers, over all corpora (default: 0); relations, or crossings or "
                  "types, must then be answered")
          .check(check_whole_number)
          .type_name("N");
  command.option("--max-gap-error", limits.gap_error, "Largest gap error")
      .check(number(true))
      .type_name("X");
  command.option("--max-normal-error", limits.normal_error, "Largest normal error")
      .check(number(true))
      .type_name("X");
  command
      .option("--time-limit", options->seconds,
              "Seconds a tool has for a corpus before it is killed (default: 300)")
      .check(number(false))
      .type_name("SECONDS");
  command
      .option("--baseline", options->baseline,
              "An earlier grade, written by --json: anything worse fails, what is better is "
              "named, times are shown beside each other")
      .not_empty()
      .type_name("FILE");
  command
      .option("--baseline-slack", options->slack,
              "Share of the baseline's errors by which they may differ (default: 0)")
      .check(number(true))
      .type_name("X");
  command.option("--json", options->json, "Also write the grade as an array of {name, unit, value}")
      .not_empty()
      .type_name("FILE");
  command.option("--html", options->html, "Also write it as a page with plots")
      .not_empty()
      .type_name("FILE");
  command.footer(kHelp);
  command.runs([options, max_wrong] {
    require_fitting(*options);
    options->demands_words = max_wrong.given();
    return run(*options);
  });
}

}  // namespace tangency::inline v0::verify
