// SPDX-License-Identifier: MIT
/// @file
/// What the main() of every tool does around its subcommands: one line for a refusal, a quiet end
/// where the reader has gone.
#pragma once

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <exception>
#include <iostream>
#include <new>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::tool {

/// Of every tool: a refused command line, input or write.
inline constexpr int kRefused = 2;

inline int complain(const std::string& message) {
  std::cerr << message << std::endl;
  return kRefused;
}

/// Letters to add, drop, replace or exchange with their neighbour to make one word of the other.
inline std::size_t slips_between(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> slips(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) slips[i][0] = i;
  std::iota(slips[0].begin(), slips[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = slips[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      slips[i][j] = std::min({slips[i - 1][j] + 1, slips[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        slips[i][j] = std::min(slips[i][j], slips[i - 2][j - 2] + 1);
      }
    }
  }
  return slips[a.size()][b.size()];
}

/// "contcat is no subcommand; the nearest is contact", or all of them where none is near.
inline std::string no_subcommand(const CLI::App& program, const std::string& word) {
  const std::vector<const CLI::App*> all =
      program.get_subcommands([](const CLI::App*) { return true; });
  const auto slips = [&](const CLI::App* one) { return slips_between(word, one->get_name()); };
  const CLI::App* nearest = *std::ranges::min_element(all, {}, slips);
  std::string text = word + " is no subcommand; ";
  // Chosen: half of the letters are right.
  if (2 * slips(nearest) <= nearest->get_name().size()) {
    return text + "the nearest is " + nearest->get_name();
  }
  for (const CLI::App* one : all) {
    if (one != all.front()) text += one == all.back() ? " and " : ", ";
    text += one->get_name();
  }
  return text + (all.size() == 1 ? " is" : " are");
}

/// Help and the version go to standard output; whatever else stops the parsing is a refusal, which
/// names a mistyped subcommand before all.
inline int exit_after(const CLI::App& program, const CLI::ParseError& stop, int argc,
                      const char* const* argv) {
  if (stop.get_exit_code() == 0) {
    std::ostringstream text;
    program.exit(stop, text);
    csv::OutputFile("-").write(text.str());
    return 0;
  }
  std::string name = program.get_name();
  for (const CLI::App* chosen : program.get_subcommands()) name += ' ' + chosen->get_name();
  std::string why = stop.what();
  if (program.get_subcommands().empty()) {
    const auto is_word = [](const char* argument) { return argument[0] != '-'; };
    const auto* const word = std::find_if(argv + std::min(argc, 1), argv + argc, is_word);
    if (word != argv + argc) why = no_subcommand(program, *word);
  }
  return complain(name + ": " + why + " (`" + name + " --help` says what is allowed)");
}

/// Runs the body of a main(). Whatever it throws is a refusal, a lost reader of its output none.
template <class Body>
int guarded(const std::string& name, Body&& body) {
  std::signal(SIGPIPE, SIG_IGN);  // an error of write(2) then, which csv::OutputFile tells
  try {
    return body();
  } catch (const csv::ReaderHasGone&) {
  } catch (const std::bad_alloc&) {
    return complain(name + ": out of memory");
  } catch (const std::exception& error) {
    return complain(error.what());
  }
  csv::end_by_broken_pipe();
}

}  // namespace tangency::tool
