// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>

#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/verify/tool/asking.hpp>
#include <tangency/verify/tool/command_line.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr const char* kHelp = R"(
Prints to the byte what a tool reads on standard input while it is graded: a header line, then
one line a row, numbers as hex floats, no comment lines.

Exit status: 0 printed; 2 refused command line or corpus, or a failed write.

Example:
  $ tangency-verify inputs near > near.csv
)";

struct Options {
  std::string corpus, corpora, out;
};

}  // namespace

void add_inputs(tables::Program& program) {
  const auto options = std::make_shared<Options>();
  tables::Command& command =
      program.subcommand("inputs", "Prints what a tool reads when it is graded");
  command.option("CORPUS", options->corpus, "The corpus").required().type_name("");
  add_corpora_option(command, options->corpora);
  command.option("--out", options->out, "File to write (default: standard output)")
      .type_name("FILE");
  command.footer(kHelp);
  command.runs([options] {
    const CorpusSource source = corpus_source(options->corpora);
    source.require(options->corpus, "CORPUS");
    tables::OutputFile out(options->out);
    out.write(inputs_for_a_tool(source.inputs(options->corpus).text));
    out.commit();
    return passed;
  });
}

}  // namespace tangency::inline v0::verify
