// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/command_line.hpp>

#include <algorithm>
#include <thread>

namespace tangency::inline v0::tool {
namespace {

// Chosen: beyond any machine this was tried on, and far below what a slip of the keyboard asks for.
constexpr unsigned kMostThreads = 1024;

}  // namespace

void add_table_options(tables::Command& command, tables::RowStreamOptions& options) {
  options.threads = std::clamp(std::thread::hardware_concurrency(), 1U, kMostThreads);
  command
      .option("--threads", options.threads,
              "Threads to compute with; the output is the same for every number (default: all "
              "cores)")
      .between(1U, kMostThreads)
      .type_name("N");
  command
      .option("--out", options.output,
              "Write here instead of to standard output; the file appears, or is replaced, only "
              "when the run succeeds")
      .not_empty()
      .type_name("FILE");
  command.option("FILE", options.input, "Input table; - or nothing means standard input")
      .not_empty()
      .type_name("");
}

void add_row_stream_options(tables::Command& command, tables::RowStreamOptions& options) {
  add_table_options(command, options);
  command.flag("--keep-going", options.keep_going,
               "Give refused rows the status invalid with empty numbers, name the first ten of "
               "them on standard error, and go on");
}

void add_mixed_terms_option(tables::Command& command, QuadricOptions& options) {
  command
      .option("--mixed-terms", options.mixed_terms,
              "What D, E, F, G, H and J of a quadric are of the factors of their terms: half "
              "(default), or full")
      .one_of({"half", "full"});
}

void add_mixed_terms_option(tables::Command& command, ConicOptions& options) {
  command
      .option("--mixed-terms", options.mixed_terms,
              "What B, D and E of a conic are of the factors of their terms: full (default), or "
              "half, as the entries of its matrix are")
      .one_of({"half", "full"});
}

}  // namespace tangency::inline v0::tool
