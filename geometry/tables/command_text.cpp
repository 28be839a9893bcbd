// SPDX-License-Identifier: MIT
#include <tangency/geometry/tables/command_text.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace tangency::inline v0::tables {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += between;
    text += word;
  }
  return text;
}

/// A line of text as troff reads it: hyphens that can be copied, no request at its beginning.
std::string troff(std::string_view line) {
  std::string text;
  if (line.starts_with('.') || line.starts_with('\'')) text = "\\&";
  for (const char c : line) {
    if (c == '\\') {
      text += "\\e";
    } else if (c == '-') {
      text += "\\-";
    } else if (c == '\'') {
      text += "\\(aq";
    } else {
      text += c;
    }
  }
  return text;
}

/// Lines as they stand.
std::string set_as_it_is(const std::string& text) {
  std::string result = ".nf\n";
  for (const std::string& line : lines_of(text)) result += troff(line) + '\n';
  return result + ".fi\n";
}

std::string troff_options(const std::vector<OptionText>& options) {
  std::string text;
  for (const OptionText& option : options) {
    text += ".TP\n\\fB" + troff(joined(option.names, ", ")) + "\\fR";
    if (!option.value.empty()) text += " \\fI" + troff(option.value) + "\\fR";
    text += '\n' + troff(option.help) + '\n';
  }
  return text;
}

std::string troff_synopsis(const std::string& names, const CommandText& command) {
  std::string text = ".B " + troff(names) + "\n[\\fIOPTIONS\\fR]";
  for (const OptionText& argument : command.arguments) {
    text += " [\\fI" + troff(argument.names.front()) + "\\fR]";
  }
  return text + "\n.br\n";
}

std::string troff_body(const CommandText& command) {
  return troff_options(command.arguments) + troff_options(command.options) +
         (command.footer.empty() ? "" : ".PP\n" + set_as_it_is(command.footer));
}

std::string capitals(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The words that a value may be, where its name lists them: "half|full".
std::vector<std::string> words_of(const OptionText& option) {
  std::vector<std::string> words;
  std::istringstream stream(option.value);
  if (option.value.find('|') == std::string::npos) return words;
  for (std::string word; std::getline(stream, word, '|');) words.push_back(word);
  return words;
}

/// Is the value the name of a file or a folder?
bool is_file(const OptionText& option) { return option.value == "FILE" || option.value == "DIR"; }

std::vector<std::string> names_of(const std::vector<OptionText>& options) {
  std::vector<std::string> names;
  for (const OptionText& option : options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::vector<std::string> names_of(const std::vector<CommandText>& commands) {
  std::vector<std::string> names;
  for (const CommandText& command : commands) names.push_back(command.name);
  return names;
}

/// A name that a shell function may have.
std::string function_name(const CommandText& program) {
  std::string name = '_' + program.name;
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Cases of "SUBCOMMAND OPTION": what completes the value of the option.
std::string bash_values(const CommandText& command, const std::string& subcommand) {
  std::string cases;
  for (const OptionText& option : command.options) {
    const std::vector<std::string> words = words_of(option);
    if (words.empty()) continue;
    for (const std::string& name : option.names) {
      cases += "    '" + subcommand + ' ' + name + "') words='" + joined(words, " ") + "' ;;\n";
    }
  }
  return cases;
}

std::string bash_options(const CommandText& command, const std::string& subcommand) {
  return "    '" + subcommand + "') words='" + joined(names_of(command.options), " ") + "' ;;\n";
}

/// In a zsh specification within single quotes.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_arguments(const CommandText& command) {
  std::string text = "_arguments -s";
  for (const OptionText& option : command.options) {
    for (const std::string& name : option.names) {
      text += " \\\n        '" + name + '[' + zsh_text(option.help) + ']';
      if (!option.value.empty()) {
        const std::vector<std::string> words = words_of(option);
        text += ':' + zsh_text(option.value) + ':' +
                (is_file(option) ? "_files"
                 : words.empty() ? " "  // zsh offers nothing
                                 : '(' + joined(words, " ") + ')');
      }
      text += '\'';
    }
  }
  for (const OptionText& argument : command.arguments) {
    text += " \\\n        '*:" + zsh_text(argument.names.front()) + ":_files'";
  }
  return text;
}

}  // namespace

std::string manual_page(const CommandText& program, const std::string& version) {
  const std::vector<std::string> description = lines_of(program.description);
  std::string summary = description.empty() ? "" : description.front();
  if (summary.starts_with(program.name + ": ")) summary.erase(0, program.name.size() + 2);
  if (summary.ends_with('.')) summary.pop_back();

  std::string page = ".TH " + capitals(program.name) + " 1 \"\" \"" + program.name + ' ' + version +
                     "\" \"User Commands\"\n.SH NAME\n" + troff(program.name) + " \\- " +
                     troff(summary) + "\n.SH SYNOPSIS\n";
  if (program.subcommands.empty()) page += troff_synopsis(program.name, program);
  for (const CommandText& command : program.subcommands) {
    page += troff_synopsis(program.name + ' ' + command.name, command);
  }
  page += ".SH DESCRIPTION\n";
  for (const std::string& line : description) page += troff(line) + '\n';
  page += ".SH OPTIONS\n" + troff_body(program);
  for (const CommandText& command : program.subcommands) {
    page += ".SH \"" + capitals(program.name + ' ' + command.name) + "\"\n" +
            troff(command.description) + '\n' + troff_body(command);
  }
  return page;
}

std::string bash_completion(const CommandText& program) {
  std::string values = bash_values(program, ""), options = bash_options(program, "");
  for (const CommandText& command : program.subcommands) {
    values += bash_values(command, command.name);
    options += bash_options(command, command.name);
  }
  const std::string subcommands = joined(names_of(program.subcommands), "|");
  std::string text = function_name(program) + R"(() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  local subcommand= words= i
)";
  if (!subcommands.empty()) {
    text += "  for ((i = 1; i < COMP_CWORD; ++i)); do\n    case ${COMP_WORDS[i]} in " +
            subcommands + ") subcommand=${COMP_WORDS[i]}; break ;; esac\n  done\n";
  }
  if (!values.empty()) text += "  case \"$subcommand $previous\" in\n" + values + "  esac\n";
  text += "  [ -n \"$words\" ] || case $current in\n  -*) case $subcommand in\n" + options +
          "  esac ;;\n";
  if (!subcommands.empty()) {
    text += "  *) [ -n \"$subcommand\" ] || words='" + joined(names_of(program.subcommands), " ") +
            "' ;;\n";
  }
  return text + "  esac\n  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n}\n" +
         "complete -o default -F " + function_name(program) + ' ' + program.name + '\n';
}

std::string zsh_completion(const CommandText& program) {
  std::string text = "#compdef " + program.name + '\n' + function_name(program) + "() {\n";
  if (program.subcommands.empty()) {
    text += "  " + zsh_arguments(program) + '\n';
  } else {
    text += "  local -a commands=(\n";
    for (const CommandText& command : program.subcommands) {
      text += "    '" + command.name + ':' + zsh_text(command.description) + "'\n";
    }
    text +=
        "  )\n  local subcommand=$words[2]\n"
        "  if (( CURRENT > 2 )); then shift words; (( CURRENT-- )); else subcommand=; fi\n"
        "  case $subcommand in\n";
    for (const CommandText& command : program.subcommands) {
      text += "    " + command.name + ")\n      " + zsh_arguments(command) + " ;;\n";
    }
    text += "    *)\n      _describe command commands\n      " + zsh_arguments(program) +
            " ;;\n  esac\n";
  }
  return text + "}\n" + function_name(program) + " \"$@\"\n";
}

}  // namespace tangency::inline v0::tables
