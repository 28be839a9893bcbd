// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/found_corpus.hpp>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/verify/answers/corpus_source.hpp>
#include <tangency/verify/hunt/search.hpp>
#include <tangency/verify/hunt/sources.hpp>

namespace tangency::inline v0::verify {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "hunt";
constexpr const char* kComment = "Found by `tangency-verify hunt`.";

// The first line that is no comment.
std::string_view header_of(std::string_view text) {
  while (text.starts_with('#')) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find_first_of("\r\n"));
}

std::string_view rows_of(std::string_view text) {
  const std::string_view header = header_of(text);
  return text.substr(static_cast<std::size_t>(header.data() - text.data()) + header.size() + 1);
}

void require_same_columns(const CorpusTable& table, const std::string& own) {
  if (header_of(table.text) == header_of(own)) return;
  throw tables::Error({.file = table.file,
                       .rule = "the columns must be those that a hunt writes: give another --out"});
}

// Rows of corpus_of(), with `first` added to the number in the comment above each and, in a truth,
// to the number that a line begins with.
std::string numbered_from(std::size_t first, std::string_view rows, bool is_truth) {
  constexpr std::string_view kAbove = "# row ";
  std::string text;
  while (!rows.empty()) {
    const std::string_view line = rows.substr(0, rows.find('\n') + 1);
    rows.remove_prefix(line.size());
    const std::size_t at = line.starts_with(kAbove) ? kAbove.size() : 0;
    std::size_t row = 0, behind = at;
    if (at > 0 || is_truth) {
      const char* const end = line.data() + line.size();
      behind =
          static_cast<std::size_t>(std::from_chars(line.data() + at, end, row).ptr - line.data());
      text.append(line.substr(0, at)) += std::to_string(row + first);
    }
    text += line.substr(behind);
  }
  return text;
}

void append(std::string& text, const std::string& more, std::size_t first, bool is_truth) {
  if (text.empty()) {
    text = more;
    return;
  }
  if (!text.ends_with('\n')) text += '\n';
  text += numbered_from(first, rows_of(more), is_truth);
}

}  // namespace

FoundCorpus::FoundCorpus(const fs::path& folder)
    : inputs_(folder / "hunt.csv"), truth_(folder / "hunt.truth.csv") {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) {
    throw tables::Error({.file = folder.string(), .rule = "cannot be made: " + problem.message()});
  }
  if (fs::exists(inputs_) || fs::exists(truth_)) {
    const CorpusSource source(folder);
    const CorpusTable inputs = source.inputs(kName), truth = source.truth(kName);
    const CorpusText own = corpus_of({}, kComment);
    require_same_columns(inputs, own.inputs);
    require_same_columns(truth, own.truth);
    tables::Reader table(inputs.named());
    for (const EllipsoidPair& pair : read_pairs(table)) {
      known_.insert(numbers(pair));
      ++rows_;
    }
    text_ = {inputs.text, truth.text};
  }
  // What cannot be written is refused before a tool is started.
  tables::OutputFile(inputs_.string());
}

std::size_t FoundCorpus::add(std::span<const NamedPair> pairs) {
  std::vector<NamedPair> fresh;
  for (const NamedPair& one : pairs) {
    if (known_.insert(numbers(one.pair)).second) fresh.push_back(one);
  }
  if (fresh.empty()) return 0;
  const CorpusText more = corpus_of(fresh, kComment);
  append(text_.inputs, more.inputs, rows_, false);
  append(text_.truth, more.truth, rows_, true);
  rows_ += fresh.size();
  tables::OutputFile inputs(inputs_.string()), truth(truth_.string());
  inputs.write(text_.inputs);
  truth.write(text_.truth);
  inputs.commit();
  truth.commit();
  return fresh.size();
}

}  // namespace tangency::inline v0::verify
