// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/words.hpp>

#include <error.h>

#include <charconv>
#include <cmath>
#include <system_error>

namespace tangency::inline v0::lammps {

std::string Words::next(const std::string& what) {
  if (!any()) refuse(what + ": missing at the end of the command");
  return words_[at_++];
}

bool Words::skip(const std::string& word) {
  const bool is_next = any() && word == words_[at_];
  if (is_next) ++at_;
  return is_next;
}

double Words::number(const std::string& key) {
  const std::string word = next(key);
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, fault] = std::from_chars(word.data(), end, value);
  if (fault != std::errc() || stop != end || !std::isfinite(value))
    refuse(key, word, "a finite number");
  return value;
}

double Words::not_negative(const std::string& key) {
  const double value = number(key);
  if (!(value >= 0.0)) refuse(key, words_[at_ - 1], "a number >= 0");
  return value;
}

double Words::positive(const std::string& key) {
  const double value = number(key);
  if (!(value > 0.0)) refuse(key, words_[at_ - 1], "a number > 0");
  return value;
}

double Words::within(const std::string& key, double least, double most,
                     const std::string& allowed) {
  const double value = number(key);
  if (!(value >= least && value <= most)) refuse(key, words_[at_ - 1], allowed);
  return value;
}

bool Words::yes(const std::string& key) {
  const std::string word = next(key);
  if (word != "yes" && word != "no") refuse(key, word, "yes or no");
  return word == "yes";
}

void Words::refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  refuse(key + " = " + value + ": " + allowed);
}

void Words::refuse(const std::string& message) {
  error->all(__FILE__, __LINE__, command_ + ": " + message);
}

}  // namespace tangency::inline v0::lammps
