// SPDX-License-Identifier: MIT
/// @file
/// Scene schema 1: the table of keys that both checks scenes and prints itself.
///
/// A new key with a fallback, a new stage kind or a new choice is no new version; a key that goes
/// away or changes its meaning is.
#pragma once

#include <iosfwd>
#include <limits>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace tangency::inline v0::dem {

/// `reals` is a list of one number or more, `words` one of one choice or more, `paths` the name of
/// a file or a list of them.
enum class KeyType { integer, real, real3, real4, reals, boolean, text, words, path, paths };

/// The tables of a scene.
inline constexpr std::string_view kSceneSections =
    "units cell motion particles wall body contact stage output sweep";

/// The values a number may have, each bound included or not.
struct Range {
  /// least value
  double low = -std::numeric_limits<double>::infinity();
  /// largest value
  double high = std::numeric_limits<double>::infinity();
  bool low_included = false;   ///< is `low` itself allowed?
  bool high_included = false;  ///< is `high` itself allowed?

  /// Is x allowed?
  bool holds(double x) const {
    return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high);
  }
};

/// A key of a scene.
struct Key {
  std::string_view section;  ///< "" or one of kSceneSections
  std::string_view name;     ///< as the file has it
  KeyType type;              ///< of its value
  std::string_view unit;     ///< "-" for none
  /// "" for a key that must be given; a value as written in TOML, a text without quotes; or, in
  /// parentheses, what holds without one.
  std::string_view fallback;
  Range range;               ///< of its value, where it is a number
  std::string_view choices;  ///< of a text or words, separated by blanks; "" for any name
  std::string_view kinds;    ///< of a stage's key: the kinds that have it, separated by blanks
  std::string_view meaning;  ///< one sentence

  /// Has a scene to say it?
  bool required() const { return fallback.empty(); }
  /// Is the default a value, and no rule in words?
  bool has_default() const { return !required() && fallback.front() != '('; }
};

/// All keys, in the order of the schema.
std::span<const Key> scene_keys();

/// Is `word` one of the blank-separated words?
bool is_among(std::string_view word, std::string_view words);

/// "integer", "number", "3 numbers", "boolean", "text" and so on.
std::string_view type_text(KeyType type);

/// "an integer from 1 to 1000000", "a number > 0 (m)", "one of place, compress, grow, relax".
std::string allowed_values(const Key& key);

/// Every key with type, unit, default, range and meaning, section by section.
void print_schema(std::ostream& out);

}  // namespace tangency::inline v0::dem
