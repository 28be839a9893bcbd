// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/verify/corpus/corpus.hpp>
#include <tangency/verify/tool/command_line.hpp>
#include <tangency/verify/tool/row_choice.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr const char* kHelp = R"(
Writes DIR/NAME.csv, the inputs, and DIR/NAME.truth.csv, what is true of them: the same
bytes every time. The larger corpora take half a minute. --seed draws other rows.

Exit status: 0 written; 2 refused command line, or a failed write.

Example:
  $ tangency-verify generate quadrics --out corpora
)";

std::string list() {
  std::string text;
  for (const CorpusInfo& corpus : corpora()) {
    std::string kind(verify::name(corpus.kind)), name(corpus.name);
    kind.resize(12, ' ');
    name.resize(21, ' ');
    text += name + kind + std::string(corpus.what) + '\n';
  }
  return text;
}

std::string check_name(const std::string& name) {
  if (std::ranges::find(corpora(), name, &CorpusInfo::name) != corpora().end()) return {};
  return name + " is not a corpus; `tangency-verify generate --list` names all";
}

// What cannot be written is refused before anything is computed.
void write(const std::filesystem::path& folder, const std::string& name, const RowChoice& choice) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) {
    throw tables::Error({.file = folder.string(), .rule = "cannot be made: " + problem.message()});
  }
  tables::OutputFile inputs((folder / (name + ".csv")).string());
  tables::OutputFile truth((folder / (name + ".truth.csv")).string());
  const CorpusText text = generate(name, choice.rows > 0 ? choice.rows : kWholeFamily, choice.seed);
  inputs.write(text.inputs);
  truth.write(text.truth);
  inputs.commit();
  truth.commit();
}

}  // namespace

void add_generate(tables::Program& program) {
  struct Options {
    bool list = false;
    std::string name, folder;
    RowChoice choice;
  };
  const auto options = std::make_shared<Options>();
  tables::Command& command = program.subcommand("generate", "Writes a corpus and its truth");
  const tables::Option list_flag =
      command.flag("--list", options->list, "Name all corpora, and write none");
  command.option("NAME", options->name, "The corpus")
      .check(check_name)
      .excludes(list_flag)
      .type_name("");
  command.option("--out", options->folder, "Folder to write to; made where it is missing")
      .excludes(list_flag)
      .type_name("DIR");
  add_seed_options(command, options->choice);
  command.footer(kHelp);
  command.runs([options] {
    if (options->list) {
      tables::OutputFile("-").write(list());
      return passed;
    }
    if (options->name.empty()) throw tables::UsageError("NAME or --list is required");
    if (options->folder.empty()) throw tables::UsageError("--out is required");
    require_seed(options->choice);
    write(options->folder, options->name, options->choice);
    return passed;
  });
}

}  // namespace tangency::inline v0::verify
