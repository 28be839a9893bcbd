// SPDX-License-Identifier: MIT
#include <tangency/geometry/tables/command_line.hpp>

#include <CLI/CLI.hpp>
#include <cxxabi.h>
#include <errno.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <numeric>
#include <optional>
#include <sstream>
#include <string_view>
#include <typeinfo>
#include <utility>

#include <tangency/geometry/tables/command_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>

namespace tangency::inline v0::tables {
namespace {

/// What --describe writes.
constexpr std::array<std::string_view, 3> kForms{"man", "bash", "zsh"};

int complain(const std::string& message) {
  std::cerr << message << std::endl;
  return kRefused;
}

/// One line, without an allocation.
int complain_of_memory(const char* name) noexcept {
  for (const char* part : {name, ": out of memory\n"}) {
    const ssize_t written = ::write(STDERR_FILENO, part, std::strlen(part));
    static_cast<void>(written);  // nobody is left to tell
  }
  return kRefused;
}

std::terminate_handler before = nullptr;

/// Where memory ends in a call that may not throw, before a program has begun, or while it tells of
/// something else, it ends as where it ends elsewhere.
[[noreturn]] void end_without_memory() {
  const std::type_info* const thrown = abi::__cxa_current_exception_type();
  if (thrown != nullptr && *thrown == typeid(std::bad_alloc))
    ::_exit(complain_of_memory(program_invocation_short_name));
  before();
  std::abort();
}

[[maybe_unused]] const bool is_set = [] {
  before = std::set_terminate(end_without_memory);
  return true;
}();

/// Letters to add, drop, replace or exchange with their neighbour to make one word of the other.
std::size_t slips_between(std::string_view a, std::string_view b) {
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

/// What the help says of an option or an argument by its place.
OptionText text_of(const CLI::Option& option) {
  OptionText text{.names = {}, .value = option.get_type_name(), .help = option.get_description()};
  if (option.get_positional()) text.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) text.names.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (option.get_positional() || option.get_items_expected_max() == 0) text.value.clear();
  return text;
}

CommandText text_of(const CLI::App& app) {
  CommandText text{.name = app.get_name(),
                   .description = app.get_description(),
                   .footer = app.get_footer(),
                   .options = {},
                   .arguments = {},
                   .subcommands = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? text.arguments : text.options).push_back(text_of(*option));
  }
  for (const CLI::App* command : app.get_subcommands({})) {
    text.subcommands.push_back(text_of(*command));
  }
  return text;
}

}  // namespace

Option Option::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

Option Option::shows_default() const {
  option_->capture_default_str();
  return *this;
}

Option Option::hidden() const {
  option_->group("");
  return *this;
}

Option Option::required() const {
  option_->required();
  return *this;
}

Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

Option Option::check(Check allowed) const {
  option_->check(CLI::Validator(std::move(allowed), ""));
  return *this;
}

template <class Number>
Option Option::between(Number low, Number high) const {
  option_->check(CLI::Range(low, high));
  return *this;
}
template Option Option::between(int, int) const;
// std::size_t is one of these two.
template Option Option::between(unsigned, unsigned) const;
template Option Option::between(unsigned long, unsigned long) const;

Option Option::one_of(const std::vector<std::string>& words) const {
  std::string names;
  for (const std::string& word : words) names += (names.empty() ? "" : "|") + word;
  option_->check(CLI::IsMember(words).description(""))->type_name(names);
  return *this;
}

Option Option::not_empty(const std::string& what) const {
  return check([what](const std::string& text) {
    return text.empty() ? "a " + what + " is empty" : std::string();
  });
}

bool Option::given() const { return option_->count() > 0; }

template <class Value>
Option Command::option(const std::string& names, Value& value, const std::string& help) {
  return Option(app_->add_option(names, value, help));
}
template Option Command::option(const std::string&, double&, const std::string&);
template Option Command::option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::option(const std::string&, int&, const std::string&);
template Option Command::option(const std::string&, unsigned&, const std::string&);
template Option Command::option(const std::string&, long&, const std::string&);
template Option Command::option(const std::string&, std::uint64_t&, const std::string&);
template Option Command::option(const std::string&, std::string&, const std::string&);
template Option Command::option(const std::string&, std::vector<std::string>&, const std::string&);

Option Command::flag(const std::string& names, bool& value, const std::string& help) {
  return Option(app_->add_flag(names, value, help));
}

void Command::footer(const std::string& text) { app_->footer(text); }

Program::Program(const std::string& name, const std::string& description,
                 const std::string& version)
    : Command(*new CLI::App(description, name)), own_(&app()) {
  if (version.empty()) return;
  own_->set_version_flag("--version", name + ' ' + version);
  // As --version does: before anything that is required is missed.
  own_->add_option_function<std::string>(
          "--describe",
          [this, version](const std::string& form) {
            if (std::ranges::find(kForms, form) == kForms.end())
              throw CLI::ValidationError("--describe",
                                         form.empty() ? "man, bash or zsh is missing"
                                                      : form + " is none of man, bash and zsh");
            std::string text = described(form, version);
            text.pop_back();  // the end of line that CLI11 prints behind it
            throw CLI::CallForVersion(text, 0);
          })
      ->expected(0, 1)  // CLI11 does not name a hidden option whose value is missing
      ->group("");
}

std::string Program::described(const std::string& form, const std::string& version) const {
  const CommandText text = text_of(*own_);
  if (form == "man") return manual_page(text, version);
  return form == "bash" ? bash_completion(text) : zsh_completion(text);
}

Program::~Program() = default;

Command& Program::subcommand(const std::string& name, const std::string& description) {
  own_->require_subcommand(1);
  subcommands_.push_back(Command(*own_->add_subcommand(name, description)));
  return subcommands_.back();
}

/// "contcat is no subcommand; the nearest is contact", or all of them where none is near.
std::string Program::no_subcommand(const std::string& word) const {
  const auto name_of = [](const Command& one) { return one.app().get_name(); };
  const auto slips = [&](const Command& one) { return slips_between(word, name_of(one)); };
  const Command& nearest = *std::ranges::min_element(subcommands_, {}, slips);
  std::string text = word + " is no subcommand; ";
  // Chosen: half of the letters are right.
  if (2 * slips(nearest) <= name_of(nearest).size()) {
    return text + "the nearest is " + name_of(nearest);
  }
  for (const Command& one : subcommands_) {
    if (&one != &subcommands_.front()) text += &one == &subcommands_.back() ? " and " : ", ";
    text += name_of(one);
  }
  return text + (subcommands_.size() == 1 ? " is" : " are");
}

int Program::refuse(const std::string& why) const {
  std::string name = own_->get_name();
  for (const CLI::App* chosen : own_->get_subcommands()) name += ' ' + chosen->get_name();
  return complain(name + ": " + why + " (`" + name + " --help` says what is allowed)");
}

int Program::parse_and_run(int argc, const char* const* argv) {
  try {
    own_->parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    if (stop.get_exit_code() == 0) {
      std::ostringstream text;
      own_->exit(stop, text);
      OutputFile("-").write(text.str());
      return 0;
    }
    // A mistyped subcommand is named before all; what follows an option of the program is none.
    const bool of_an_option = dynamic_cast<const CLI::ValidationError*>(&stop) != nullptr;
    if (!of_an_option && !subcommands_.empty() && own_->get_subcommands().empty()) {
      const auto is_word = [](const char* argument) { return argument[0] != '-'; };
      const auto* const word = std::find_if(argv + std::min(argc, 1), argv + argc, is_word);
      if (word != argv + argc) return refuse(no_subcommand(*word));
    }
    return refuse(stop.what());
  }
  const auto chosen =
      std::ranges::find_if(subcommands_, [](const Command& one) { return one.app().parsed(); });
  try {
    const int status = chosen == subcommands_.end() ? body_() : chosen->body_();
    flush_standard_output();
    return status;
  } catch (const UsageError& error) {
    return refuse(error.what());
  }
}

int Program::run(int argc, const char* const* argv) {
  std::signal(SIGPIPE, SIG_IGN);  // an error of write(2) then, which OutputFile tells
  try {
    return parse_and_run(argc, argv);
  } catch (const ReaderHasGone&) {
  } catch (const std::bad_alloc&) {
    return complain_of_memory(own_->get_name().c_str());
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(own_->get_name() + ": " + error.what());
  } catch (const std::exception& error) {
    return complain(error.what());
  }
  end_by_broken_pipe();
}

}  // namespace tangency::inline v0::tables
