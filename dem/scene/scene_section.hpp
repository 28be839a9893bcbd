// SPDX-License-Identifier: MIT
/// @file
/// One table of a scene, checked against scene_keys(): values by name, and errors that name file,
/// line, key and what is allowed.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/dem/scene/scene_error.hpp>
#include <tangency/dem/scene/scene_keys.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// A value on one line, as TOML writes it.
std::string text_of(const toml::node& node);

/// Is the value one of those that the key may have?
bool fits(const Key& key, const toml::node& node);

/// A number in messages, three digits.
std::string short_text(double x);

/// A name in a scene: also part of a key's path, so without '-', '.' and blanks.
bool is_name(std::string_view text);

/// What stands before KEY=VALUE where messages name a setting of the command line in place of a
/// file and a line.
inline constexpr const char* kSetOption = "--set ";

/// What every message starts with.
class Source {
 public:
  explicit Source(std::string name) : name_(std::move(name)) {}

  /// The file of a place: that which was parsed under its own name, or else this one.
  std::string file_of(const toml::source_region& place) const;
  /// "scene.toml:12", or "--set KEY=VALUE"
  std::string at(const toml::source_region& place) const;
  [[noreturn]] void fail(const toml::source_region& place, const std::string& message) const;
  /// For what is missing from the whole file.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string name_;
};

class Section {
 public:
  /// @param path     what messages call the table: "particles.p"; "" for the top level
  /// @param section  of scene_keys()
  /// @param kind     of a stage, else ""
  /// @param base     looked in for keys that the table lacks: [contact] for [contact.a-b]
  /// @throws SceneError  for unknown keys, values that do not fit and required keys that are
  /// missing
  Section(const Source& source, const toml::table& table, std::string path,
          std::string_view section, std::string_view kind = {}, const toml::table* base = nullptr);

  /// Refuses the value of a key that the section has.
  [[noreturn]] void fail(std::string_view name, const std::string& allowed) const;
  /// Refuses the section for a key that it lacks.
  [[noreturn]] void fail_missing(std::string_view name) const;
  /// Refuses a number that may be the key's default: then at the table's line.
  [[noreturn]] void refuse(std::string_view name, std::int64_t value,
                           const std::string& allowed) const;
  /// Refuses a key if the section has it.
  void forbid(std::string_view name, const std::string& why) const {
    if (has(name)) fail(name, why);
  }

  bool has(std::string_view name) const { return find(name) != nullptr; }
  double real(std::string_view name) const;
  std::optional<double> optional_real(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  std::optional<std::int64_t> optional_integer(std::string_view name) const;
  bool boolean(std::string_view name) const;
  /// None where the section does not have the key.
  std::vector<double> reals(std::string_view name) const;
  std::vector<std::string> words(std::string_view name) const;
  std::string text(std::string_view name, std::string_view otherwise) const;
  std::string text(std::string_view name) const { return text(name, fallback(name)); }
  std::optional<Vec3> optional_real3(std::string_view name) const;
  std::optional<Eigen::Vector4d> optional_real4(std::string_view name) const;

 private:
  bool applies(const Key& key) const;
  std::string label(std::string_view name) const;
  void check(const toml::key& name, const toml::node& node) const;
  const toml::node* find(std::string_view name) const;
  std::string_view fallback(std::string_view name) const;

  const Source& source_;
  const toml::table& table_;
  std::string path_;
  std::string section_, kind_;
  const toml::table* base_;
};

/// The tables [[name]] of a list.
/// @throws SceneError  where the value is another, or the list is empty
const toml::array& tables_of(const Source& source, const toml::node& node, const std::string& name);

/// Number k of them.
Section section_of(const Source& source, const toml::array& tables, const std::string& name,
                   std::size_t k);

}  // namespace tangency::inline v0::dem
