// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/command_line.hpp>

#include <algorithm>
#include <string>
#include <thread>

#include <tangency/geometry/tables/not_empty.hpp>

namespace tangency::tool {
namespace {

// Chosen: beyond any machine this was tried on, and far below what a slip of the keyboard asks for.
constexpr unsigned kMostThreads = 1024;

}  // namespace

void add_row_stream_options(CLI::App& app, RowStreamOptions& options) {
  options.threads = std::clamp(std::thread::hardware_concurrency(), 1U, kMostThreads);
  app.add_option("--threads", options.threads,
                 "Threads to compute with; the output is the same for every number (default: all "
                 "cores)")
      ->check(CLI::Range(1U, kMostThreads))
      ->type_name("N");
  app.add_option("--out", options.output,
                 "Write here instead of to standard output; the file appears, or is replaced, only "
                 "when the run succeeds")
      ->check(not_empty())
      ->type_name("FILE");
  app.add_flag("--keep-going", options.keep_going,
               "Give refused rows the status invalid with empty numbers, name the first ten of "
               "them on standard error, and go on");
  app.add_option("FILE", options.input, "Input table; - or nothing means standard input")
      ->check(not_empty())
      ->type_name("");
}

}  // namespace tangency::tool
