// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/answers/corpus_source.hpp>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include <tangency/verify/answers/truth_table.hpp>

namespace tangency::inline v0::verify {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kInputsSuffix = ".csv", kTruthSuffix = ".truth.csv";

[[noreturn]] void refuse(const std::string& where, const std::string& rule) {
  throw tables::Error({.file = where, .rule = rule});
}

std::string contents(const fs::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream || errno != 0) {
    refuse(file.string(), "cannot be read: " + std::generic_category().message(errno));
  }
  return text;
}

}  // namespace

CorpusSource::CorpusSource() {
  for (const BuiltInCorpus& corpus : built_in_corpora()) names_.emplace_back(corpus.name);
}

CorpusSource::CorpusSource(const fs::path& folder) : folder_(folder) {
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder, problem)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(kTruthSuffix)) continue;
    names_.push_back(file.substr(0, file.size() - kTruthSuffix.size()));
  }
  if (problem) refuse(folder.string(), "cannot be read: " + problem.message());
  std::ranges::sort(names_);
}

CorpusSource::CorpusSource(std::span<const CorpusInfo> corpora, Maker make)
    : infos_(corpora), make_(std::move(make)) {
  for (const CorpusInfo& corpus : corpora) names_.emplace_back(corpus.name);
  std::ranges::sort(names_);
}

std::string CorpusSource::version() const {
  if (make_) return {};
  if (!folder_) return std::string(built_in_version());
  std::ifstream file(*folder_ / "VERSION");
  std::string version;
  std::getline(file, version);
  return version;
}

std::string CorpusSource::place(const std::string& option) const {
  return folder_ ? folder_->string() : option;
}

void CorpusSource::require(const std::string& name, const std::string& option) const {
  if (std::ranges::find(names_, name) != names_.end()) return;
  if (names_.empty())
    refuse(place(option), "there is no corpus here: a corpus NAME is a file NAME.truth.csv");
  std::string rule = "there is no corpus " + name + " here; there are:";
  for (const std::string& known : names_) rule += ' ' + known;
  refuse(place(option), rule);
}

std::vector<std::string> CorpusSource::chosen(const std::vector<std::string>& wanted) const {
  for (const std::string& name : wanted) {
    if (std::ranges::count(wanted, name) > 1) {
      refuse("--corpus", name + " is named more than once");
    }
    require(name);
  }
  if (!wanted.empty()) return wanted;
  std::vector<std::string> pairs = names_;
  std::erase_if(pairs, [&](const std::string& name) { return kind(name) != CorpusKind::pairs; });
  if (pairs.empty()) refuse(place(), "there is no corpus of pairs here");
  return pairs;
}

CorpusKind CorpusSource::kind(const std::string& name) const {
  if (make_) return std::ranges::find(infos_, name, &CorpusInfo::name)->kind;
  const CorpusTable table = truth(name);
  return kind_of_truth(tables::Reader(table.named()).header());
}

bool CorpusSource::has_inputs(const std::string& name) const {
  return !folder_ || fs::exists(*folder_ / (name + std::string(kInputsSuffix)));
}

CorpusTable CorpusSource::inputs(const std::string& name) const {
  return table(name, &BuiltInCorpus::inputs, kInputsSuffix);
}

CorpusTable CorpusSource::truth(const std::string& name) const {
  return table(name, &BuiltInCorpus::truth, kTruthSuffix);
}

CorpusTable CorpusSource::table(const std::string& name, std::string_view BuiltInCorpus::*built_in,
                                std::string_view suffix) const {
  const std::string file = name + std::string(suffix);
  if (folder_) return {(*folder_ / file).string(), contents(*folder_ / file)};
  if (make_) {
    if (!made_.contains(name)) made_[name] = make_(name);
    const CorpusText& made = made_[name];
    return {file, suffix == kTruthSuffix ? made.truth : made.inputs};
  }
  const auto found = std::ranges::find(built_in_corpora(), name, &BuiltInCorpus::name);
  assert(found != built_in_corpora().end());
  return {file, std::string((*found).*built_in)};
}

}  // namespace tangency::inline v0::verify
