// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/verify/show/pair_code.hpp>
#include <tangency/verify/show/pair_picture.hpp>
#include <tangency/verify/tool/asking.hpp>
#include <tangency/verify/tool/command_line.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr const char* kHelp = R"(
Shows one row of a corpus: its inputs in decimal and as hex floats, what is true of it, what was
answered and what is wrong with that, and a pair of ellipsoids as code that compiles and runs.
A tool is asked about the whole corpus, as `tangency-verify grade` asks it. Of lists of neighbours
a row is a body, shown with all pairs that it is in. Pairs of ellipsoids at rest, by their axes,
have code and a picture, ellipses a picture; all else has its line of the table alone.

The picture looks along the common perpendicular of the line of centres and the normal: in its
plane the distance of both outlines along the normal is the true gap.

Exit status: 0 shown; 2 refused command line, corpus or row, or a failed write.

Examples:
  $ tangency-verify show near 7 --tool 'tangency contact' --svg near-7.svg
  $ tangency-verify show near 7 --as cpp > near-7.cpp
)";

constexpr double kSecondsOfATool = 300;  // chosen: as of grade

struct Options {
  std::string corpus, row, corpora, answers, tool, svg, code, out;
  std::string definition = "common-normal";
};

// What is known of the row.
struct Row {
  CorpusKind kind;
  std::string name, header_line;  // "near row 7", of the inputs
  std::size_t index;
  InputRow input;
  std::vector<Cells> truth;
  TruthRow true_row;
  std::string family;
  std::array<double, 3> normal;
};

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

// As they stand, and in decimal before what is not. What every line says is said in the head.
std::string table_of(const Cells& cells) {
  std::string text;
  for (const auto& [name, value] : cells) {
    if (name == "row" || name == "family") continue;
    double number = 0;
    const bool is_hex = value.find_first_of("xX") != value.npos;
    const bool is_number = is_hex && !tables::parse_number(value, number);
    text += "  " + padded(name, 13) + (is_number ? padded(tables::to_text(number), 25) : "") +
            value + '\n';
  }
  return text;
}

// Of a line of neighbours: both bodies, for either may be the one that is shown.
std::vector<std::string> columns_about(CorpusKind kind, const std::string& first) {
  if (kind == CorpusKind::neighbours) return {first, "j"};
  return {"row"};
}

// A line a pair: `i 3 j 13 ix 0 iy 0 iz 0 relation overlap`.
std::string pairs_of(const std::vector<Cells>& lines) {
  std::string text;
  for (const Cells& cells : lines) {
    if (std::ranges::find(cells, "j", &Cells::value_type::first) == cells.end()) continue;
    text += ' ';
    for (const auto& [name, value] : cells) {
      if (name != "family") text += ' ' + (name == "row" ? "i" : name) + ' ' + value;
    }
    text += '\n';
  }
  return text.empty() ? "  no pair with this body\n" : text;
}

// Of every further line what it says otherwise: the other normals.
std::string truth_of(const std::vector<Cells>& lines, CorpusKind kind) {
  if (kind == CorpusKind::neighbours) return "true\n" + pairs_of(lines);
  std::string text = "true\n" + table_of(lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    Cells other = lines[i];
    std::erase_if(other, [&](const auto& cell) {
      return std::ranges::find(lines.front(), cell) != lines.front().end();
    });
    text += "and\n" + table_of(other);
  }
  return text;
}

// What is wrong; below it, how far off numbers are that no threshold is held against.
std::string judgement(const Grade& grade, const Row& row, CorpusKind kind) {
  std::string wrong, errors;
  for (const Finding& found : grade.findings) {
    if (found.row != row.index) continue;
    const bool is_error =
        found.problem == Problem::gap_error || found.problem == Problem::normal_error;
    (is_error ? errors : wrong) +=
        (is_error ? "  " : "  " + std::string(to_string(found.problem)) + ": ") +
        text_of(found, kind) + '\n';
  }
  return (wrong.empty() ? "nothing of it is wrong\n" : "wrong\n" + wrong) +
         (errors.empty() ? "" : "errors\n" + errors);
}

std::string answer_of(const std::vector<Cells>& lines, const Grade& grade, const Row& row,
                      CorpusKind kind) {
  if (kind == CorpusKind::neighbours)
    return "answered\n" + pairs_of(lines) + judgement(grade, row, kind);
  std::string text;
  for (const Cells& line : lines) text += "answered\n" + table_of(line);
  return (text.empty() ? "no answer\n" : text) + judgement(grade, row, kind);
}

Row row_of(const Options& options, const CorpusSource& source, const TruthTable& truth) {
  const CorpusTable inputs = source.inputs(options.corpus);
  std::size_t index = 0;
  std::from_chars(options.row.data(), options.row.data() + options.row.size(), index);
  const auto input = input_row(inputs.named(), index);
  if (!input || index >= truth.rows.size()) {
    throw tables::Error({.file = inputs.file,
                         .rule = "there is no row " + options.row + " here; there are 0 to " +
                                 std::to_string(truth.rows.size() - 1)});
  }
  const CorpusTable table = source.truth(options.corpus);
  const TruthRow& true_row = truth.rows[index];
  Row row{truth.kind,
          options.corpus + " row " + options.row,
          {},
          index,
          *input,
          lines_about(tables::Reader(table.named()), index, columns_about(truth.kind, "row")),
          true_row,
          truth.families[true_row.family],
          {1, 0, 0}};
  if (true_row.normals > 0) row.normal = truth.maximisers[true_row.first_normal].normal;
  const std::string text = inputs_for_a_tool(inputs.text);
  row.header_line = text.substr(0, text.find('\n'));
  return row;
}

// The cells of the true row that a comment has room for.
std::string truth_in_a_line(const Row& row) {
  std::string text;
  for (const auto& [name, value] : row.truth.front()) {
    if (name == "relation" || name == "gap") {
      text += (text.empty() ? "" : ", ") + name + ' ' + value;
    }
  }
  return text;
}

std::string csv_of(const Row& row) {
  std::string text = row.header_line + '\n', line;
  for (const auto& cell : row.input.cells) line += (line.empty() ? "" : ",") + cell.second;
  return text + line + '\n';
}

std::string code_of(const std::string& code, const Row& row) {
  if (code == "csv") return csv_of(row);
  return as_code(code, *solids_of(row.input.cells), row.name + ", family " + row.family,
                 truth_in_a_line(row));
}

// The bodies of a pair at rest: code and picture know no motion.
std::optional<Solids> pair_of(const Row& row) {
  return row.kind == CorpusKind::times ? std::nullopt : solids_of(row.input.cells);
}

// Ellipsoids have code in every language; what is none has a table.
bool has_code(const std::string& code, const Row& row) {
  const auto is_of_a_body = [](const auto& cell) { return cell.first == "a.qw"; };
  return code == "csv" || (pair_of(row) && std::ranges::any_of(row.input.cells, is_of_a_body));
}

std::string all_codes(const Row& row) {
  std::string text;
  for (const std::string_view code : kCodes) {
    const std::string name(code);
    if (has_code(name, row)) text += "\n--- " + name + "\n" + code_of(name, row);
  }
  if (row.kind == CorpusKind::neighbours)
    return text + "\nThis is one body of a list; `tangency-verify inputs` prints all.\n";
  if (!has_code("cpp", row))
    text += "\nThere is no other code: pairs of ellipsoids at rest, by their axes, have it.\n";
  return text;
}

std::string shown_row(const Options& options, const CorpusSource& source, const Row& row,
                      const TruthTable& truth) {
  const CorpusTable inputs = source.inputs(options.corpus);
  std::string text = row.name + ": family " + row.family + ", " + inputs.file + ':' +
                     std::to_string(row.input.line) + '\n' + table_of(row.input.cells) +
                     truth_of(row.truth, row.kind);
  const Demands every_error{false, 0.0, 0.0};
  if (!options.tool.empty()) {
    const ToolRun run = asked(options.tool, inputs, truth.rows.size(), kSecondsOfATool);
    text += "the tool " + run.ending +
            (run.last_words.empty() ? "" : "; its last words: " + run.last_words) + '\n';
    const tables::NamedText answers{"answers", run.output};
    std::vector<Cells> lines;
    try {
      lines = lines_about(tables::Reader(answers), row.index, columns_about(row.kind, "i"));
    } catch (const tables::Error& error) {  // no header
      text += "its answers cannot be read: " + std::string(error.what()) + '\n';
    }
    text += answer_of(lines, grade(truth, answers, every_error), row, truth.kind);
  } else if (!options.answers.empty()) {
    require_readable(options.answers);
    text += answer_of(
        lines_about(tables::Reader(options.answers), row.index, columns_about(row.kind, "i")),
        grade(truth, options.answers, every_error), row, truth.kind);
  }
  return text + all_codes(row);
}

ExitStatus run(const Options& options) {
  const CorpusSource source = corpus_source(options.corpora);
  source.require(options.corpus, "CORPUS");
  const CorpusTable table = source.truth(options.corpus);
  const TruthTable truth =
      read_truth(tables::Reader(table.named()), definition_named(options.definition));
  const Row row = row_of(options, source, truth);
  const auto solids = pair_of(row);
  if (!options.svg.empty() && !solids) {
    throw tables::UsageError("--svg: " + row.name +
                             " has no picture; pairs of bodies at rest, by their axes, have");
  }
  if (!options.code.empty() && !has_code(options.code, row)) {
    throw tables::UsageError(
        "--as: " + row.name +
        " has no code but csv; pairs of ellipsoids at rest, by their axes, have");
  }
  tables::OutputFile out(options.out);
  const auto svg =
      options.svg.empty() ? nullptr : std::make_unique<tables::OutputFile>(options.svg);
  out.write(options.code.empty() ? shown_row(options, source, row, truth)
                                 : code_of(options.code, row));
  if (svg) {
    svg->write(
        picture(*solids, row.normal, row.name + ", family " + row.family, truth_in_a_line(row)));
    svg->commit();
  }
  out.commit();
  return passed;
}

std::string check_row(const std::string& text) {
  std::size_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem == std::errc() && end == text.data() + text.size()) return {};
  return text + " is not a whole number from 0";
}

void require_fitting(const Options& options) {
  if (!options.tool.empty() && !options.answers.empty()) {
    throw tables::UsageError("--answers and --tool exclude each other");
  }
  if (!options.code.empty() && !(options.tool.empty() && options.answers.empty())) {
    throw tables::UsageError("--as prints the pair alone: without --answers and --tool");
  }
  if (options.answers == "-" && options.code.empty()) {
    throw tables::UsageError("--answers: a file is required, which is read twice");
  }
}

}  // namespace

void add_show(tables::Program& program) {
  const auto options = std::make_shared<Options>();
  tables::Command& command = program.subcommand(
      "show", "Shows one row of a corpus, what is wrong with its answer, and code");
  command.option("CORPUS", options->corpus, "The corpus").required().type_name("");
  command.option("ROW", options->row, "The row, from 0").required().check(check_row).type_name("");
  command.option("--answers", options->answers, "A table of answers to the corpus")
      .not_empty()
      .type_name("FILE");
  command.option("--tool", options->tool, "A shell command that is asked, as by grade")
      .not_empty("command")
      .type_name("COMMAND");
  command.option("--svg", options->svg, "Also draw the pair").not_empty().type_name("FILE");
  command
      .option("--as", options->code,
              "Print the pair as this code and nothing else (default: all of them, last)")
      .one_of({kCodes.begin(), kCodes.end()})
      .type_name("CODE");
  add_corpora_option(command, options->corpora);
  add_definition_option(command, options->definition);
  command.option("--out", options->out, "File to write (default: standard output)")
      .type_name("FILE");
  command.footer(kHelp);
  command.runs([options] {
    require_fitting(*options);
    return run(*options);
  });
}

}  // namespace tangency::inline v0::verify
