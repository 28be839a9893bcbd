// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/answers/tool_run.hpp>
#include <tangency/verify/grade/baseline.hpp>
#include <tangency/verify/grade/outputs.hpp>
#include <tangency/verify/tool/asking.hpp>
#include <tangency/verify/tool/command_line.hpp>
#include <tangency/verify/tool/output_files.hpp>
#include <tangency/verify/tool/row_choice.hpp>
#include <tangency/version.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr const char* kHelp = R"(
What is graded is a table with the column row, the number of the input row from 0, and
any of these; what its header names is asked of every row:
  relation     separate, external_touch, overlap, internal_touch, a_in_b, b_in_a, equal
  overlaps     0 or 1: do the interiors meet
  gap          signed; and gap_error, a bound >= 0 on its error that is claimed to hold (of
               a row with the status local: for a local gap, the true one is not below
               gap - gap_error). Of points its sign tells inside from outside
  nx ny nz     unit normal from a to b, of length 1 to three digits; of ellipses nx ny
  crossings, area   of ellipses
  type         of quadrics
  result, t1, t2   of rays
  status, time, latest   of times of contact; latest is a claimed bound
  i j ix iy iz     a pair of neighbours, a line a pair, without row
A tool gets the inputs on standard input, a table without comment lines whose numbers are
hex floats, in the columns of the command that answers its kind: `tangency contact` (pairs,
shape matrices and floats), `ellipse`, `classify`, `point`, `wall`, `ray`, `time` or
`neighbours`. docs/grading.md has the kind of every corpus.

The grade, family by family, of pairs, rows or bodies:
  wrong        answers that differ from the exact relation, crossings, type, result, status or
               side; neighbours that are listed and share no point
  touches      overlaps 1 on an external touch: counted here and never as wrong
  missing      rows without a whole answer, cells that are no answer included; neighbours that
               are not listed, those that only touch included
  broken       rows whose error is above their gap_error; times whose first contact is before
               `time` or after `latest`
  reversed     normals more than 90 degrees from every true one: those from b to a
  gap error    |gap - truth| / L, L the distance of the centres and both largest semi-axes (of
               points and walls: from the centre, and the largest semi-axis); of floats in
               2^-24 L
  normal error length of the difference to the nearest true normal; of floats in 2^-24
  area error   |area - truth| / area of the smaller ellipse
  t error      of rays: |t - truth| |direction| / L, L from the origin, the worse of t1 and t2
  time error   distance of `time` from the true interval, in tolerances
  with median, 99 %, largest and the row of the largest; then rows that are answered twice,
  that the corpus does not have, or that cannot be read.

The first ten rows of every family with a fault are named, with the line of NAME.csv where they
stand, what was answered and what is true; `tangency-verify show` tells more of one. The last line
is the verdict, `passed: ` or `FAILED: ` and the totals over all corpora; every reason to fail has
a line before it. Where GITHUB_ACTIONS is true, ten of these are GitHub's annotations, too.

Files of a grade appear whole, once it has ended; SOURCE_DATE_EPOCH sets the date in them.

Exit status: 0 every row answered, none wrong, every threshold kept; 1 answers are wrong,
missing, faulty or beyond a threshold, worse than the baseline, a claimed bound is broken, a
normal is reversed, no row is judged, or the tool was ended by a signal, hung or printed without end (its own
exit status is shown and decides nothing); 2 refused command line or corpus, or a failed
write.

Example:
  $ tangency-verify grade --tool 'tangency contact' --max-gap-error 1e-15
)";

struct Options {
  std::string answers, tool, baseline;
  RowChoice rows;
  OutputPaths outputs;
  std::string definition = "common-normal";
  std::vector<std::string> names;
  Thresholds thresholds;
  bool demands_words = false;
  double slack = 0;
  double seconds = 300;  // chosen: a thousand times what a corpus takes
};

CorpusGrade graded(const Options& options, const CorpusSource& source, const SetAside& aside,
                   const std::string& name) {
  const CorpusTable table = source.truth(name);
  TruthTable truth =
      read_truth(tables::Reader(table.named()), definition_named(options.definition));
  leave_out(aside.not_claimed, name, truth);
  aside.expected.mark(name, truth);
  if (truth.rows.empty()) {
    throw tables::Error({.file = table.file, .rule = "a corpus must have rows"});
  }
  const Thresholds& limits = options.thresholds;
  const Demands demands{options.demands_words, limits.gap_error,
                        truth.has_normals ? limits.normal_error : std::nullopt};
  if (options.tool.empty()) {
    require_readable(options.answers);
    InputLines lines;  // which only say where a row stands
    if (source.has_inputs(name)) lines = input_lines(source.inputs(name), truth.rows.size());
    return {name, truth.kind, grade(truth, options.answers, demands), std::nullopt,
            std::move(lines)};
  }
  const CorpusTable inputs = source.inputs(name);
  InputLines lines = input_lines(inputs, truth.rows.size());
  const ToolRun run = asked(options.tool, inputs, truth.rows.size(), options.seconds);
  return {name, truth.kind, grade(truth, tables::NamedText{"answers", run.output}, demands),
          RunNote{run.sound, run.ending, run.last_words, run.seconds, !run.output.empty()},
          std::move(lines)};
}

std::string allowed(const std::optional<double>& most, const char* unit) {
  return most ? tables::to_text(*most) + unit : "any";
}

GradeReport begun(const Options& options, const CorpusSource& source) {
  const Thresholds& limits = options.thresholds;
  const bool is_tool = !options.tool.empty();
  GradeReport report{.title = is_tool ? options.tool : options.answers,
                     .program_version = TANGENCY_VERSION_STRING,
                     .date = date_of_outputs(),
                     .facts = {},
                     .thresholds = limits};
  report.facts = {{is_tool ? "tool" : "answers", report.title},
                  {"definition", options.definition},
                  {"wrong answers allowed", std::to_string(limits.wrong)},
                  {"largest gap error allowed", allowed(limits.gap_error, " L")},
                  {"largest normal error allowed", allowed(limits.normal_error, "")},
                  {"tangency-verify", report.program_version},
                  {"date", report.date + 'Z'}};
  for (const auto& fact : facts_of(options.rows, source)) report.facts.push_back(fact);
  return report;
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

// Expected failures that are none any more.
std::string mended(const GradeReport& report, const std::string& expected) {
  std::vector<std::string> rows, lines;
  for (const CorpusReport& corpus : report.corpora) {
    for (const std::size_t row : corpus.mended) {
      rows.push_back(corpus.name + ',' + std::to_string(row));
    }
  }
  append_named(lines, "BETTER than " + expected + " expects, which need not name it: ", rows);
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

// Where the rows can be read again: fresh ones have first to be written.
std::string folder_of_rows(const RowChoice& rows) {
  if (rows.seed == 0) return rows.folder;
  return "DIR, which tangency-verify generate CORPUS --out DIR --seed " +
         std::to_string(rows.seed) + (rows.rows > 0 ? " --rows " + std::to_string(rows.rows) : "") +
         " writes";
}

ExitStatus run(const Options& options) {
  const CorpusSource source = source_of(options.rows);
  const SetAside aside = set_aside(options.rows, source);
  const Baseline baseline = options.baseline.empty() ? Baseline() : read_baseline(options.baseline);
  OutputFiles outputs(options.outputs);
  tables::OutputFile screen("-");
  GradeReport report = begun(options, source);
  for (const std::string& name : source.chosen(options.names)) {
    screen.write(as_table(add(report, graded(options, source, aside, name))) + '\n');
  }
  std::vector<std::string> further;
  if (!options.baseline.empty()) {
    const Comparison beside = compare(report.corpora, baseline, options.slack);
    screen.write(differences(beside, options.baseline));
    append_named(further, "worse than the baseline: ", beside.worse);
  }
  screen.write(mended(report, options.rows.expected));
  judge(report, further);
  outputs.write(report);
  screen.write(closing_of(report, folder_of_rows(options.rows)));
  return report.has_passed() ? passed : failed;
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
  add_row_options(command, options->rows);
  add_definition_option(command, options->definition);
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
  add_output_options(command, options->outputs);
  command.footer(help_on_features() + kHelp);
  command.runs([options, max_wrong] {
    require_fitting(*options);
    options->demands_words = max_wrong.given();
    return run(*options);
  });
}

}  // namespace tangency::inline v0::verify
