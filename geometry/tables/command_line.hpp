// SPDX-License-Identifier: MIT
/// @file
/// The command line of every program, and the frame of its main(): docs/decisions/0004.
///
/// (1) A refused command line, input or write is one line on standard error and the status 2.
/// (2) Help and the version go to standard output, whose full disk is an error.
/// (3) Where the reader of standard output has gone, as of `| head`, the program ends as if SIGPIPE
///     had ended it.
/// (4) Where memory ends, in whatever call, a line says so and the status is 2. GMP says it in a
///     line of its own and aborts.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): that of the library
class App;
class Option;
}  // namespace CLI

namespace tangency::inline v0::tables {

/// Of every program: a refused command line, input or write.
inline constexpr int kRefused = 2;

/// Says what of a value is not allowed; nothing for one that is.
using Check = std::function<std::string(const std::string& text)>;

/// Of what stands in the command line and does not fit together; what() says what is missing.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option, a flag or an argument without a name, as it is being described. A handle: copies
/// describe the same.
class Option {
 public:
  /// What the help calls its value; nothing leaves the name out. Shells complete FILE and DIR.
  Option type_name(const std::string& name) const;
  /// The help names the default, which is the value now.
  Option shows_default() const;
  /// The help does not name it.
  Option hidden() const;
  Option required() const;
  Option excludes(const Option& other) const;
  Option check(Check allowed) const;
  /// Of an `int`, `unsigned` or `std::size_t`, ends included.
  template <class Number>
  Option between(Number low, Number high) const;
  Option one_of(const std::vector<std::string>& words) const;
  /// Refuses the empty text that a script's unset variable leaves.
  Option not_empty(const std::string& what = "file name") const;

  /// Was it on the command line?
  bool given() const;

 private:
  friend class Command;
  explicit Option(CLI::Option* option) : option_(option) {}
  CLI::Option* option_;
};

/// A subcommand, or the program itself.
class Command {
 public:
  /// @param names  "--out", or "FILE" for an argument by its place
  /// @param value  of a `double`, a `std::optional` of it, an `int`, `unsigned`, `long` or
  ///               `std::uint64_t`, a string or, given any number of times, a vector of strings;
  ///               outlives the parsing
  template <class Value>
  Option option(const std::string& names, Value& value, const std::string& help = "");
  Option flag(const std::string& names, bool& value, const std::string& help = "");
  /// Stands at the end of the help.
  void footer(const std::string& text);
  /// What the command does, once the command line has been parsed: returns the exit status, or
  /// throws: UsageError for options that do not fit together.
  void runs(std::function<int()> body) { body_ = std::move(body); }

 protected:
  explicit Command(CLI::App& app) : app_(&app) {}
  CLI::App& app() const { return *app_; }

 private:
  friend class Program;
  CLI::App* app_;
  std::function<int()> body_;
};

class Program : public Command {
 public:
  /// @param version  what --version says behind the name; nothing for a program that has none. One
  ///                 that has, and so is installed, also has the hidden `--describe man|bash|zsh`:
  ///                 command_text.hpp
  Program(const std::string& name, const std::string& description, const std::string& version = "");
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// A program that has any needs one of them.
  Command& subcommand(const std::string& name, const std::string& description);

  /// The whole of a main(): parses, does what the chosen command runs, and returns the exit status.
  /// Whatever is thrown is a refusal.
  int run(int argc, const char* const* argv);

 private:
  int parse_and_run(int argc, const char* const* argv);
  int refuse(const std::string& why) const;
  std::string described(const std::string& form, const std::string& version) const;
  std::string no_subcommand(const std::string& word) const;

  std::unique_ptr<CLI::App> own_;
  std::deque<Command> subcommands_;
};

}  // namespace tangency::inline v0::tables
