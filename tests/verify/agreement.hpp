// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The frame of the agreement programs, which hold the kernel against an oracle on as many inputs
/// as asked for: --seed, what the program counts, a table of what was seen, a last line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include <tangency/geometry/tables/command_line.hpp>

namespace tangency::testing {

class AgreementProgram {
 public:
  AgreementProgram(const std::string& name, const std::string& description)
      : program_(name, description) {}

  /// The help names the default, which is the value now.
  template <class Value>
  tables::Option option(const std::string& name, Value& value, const std::string& help = "") {
    return program_.option(name, value, help).shows_default();
  }

  /// The whole of the main(): prints the seed, what `kept` prints, and "agrees" or "DISAGREES" as
  /// the last line.
  /// @param kept  whether everything that is promised was seen
  /// @returns 0 where it was, 1 where it was not, 2 for a refused command line
  int run(int argc, const char* const* argv, const std::function<bool(std::uint64_t seed)>& kept);

 private:
  tables::Program program_;
};

/// Calls part(0), part(1) ... below `parts` from so many threads, and says on standard error how
/// far they are.
void for_each_part(unsigned threads, std::size_t parts,
                   const std::function<void(std::size_t)>& part);

}  // namespace tangency::testing
