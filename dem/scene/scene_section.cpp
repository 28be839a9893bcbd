// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_section.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// The shortest text that reads back to x: toml++ writes 0.05 with 17 digits.
std::string text_of(double x) {
  const std::string text = tables::to_text(x);
  return text.find_first_not_of("-0123456789") == text.npos ? text + ".0" : text;
}

/// Of a number, rounded: toml++ has no double for an integer that is not exactly one.
double real_of(const toml::node& node) {
  return node.is_integer() ? static_cast<double>(node.ref<std::int64_t>()) : node.ref<double>();
}

/// What stands in a scene may be shown: control characters, which a terminal obeys, as `?`.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, '?');
  return text;
}

bool is_path(const toml::node& node) {
  return node.is_string() && !node.ref<std::string>().empty();
}

template <class Vector>
std::optional<Vector> vector_of(const toml::node* node) {
  if (!node) return std::nullopt;
  Vector v;
  for (Eigen::Index k = 0; k < v.size(); ++k)
    v[k] = real_of(*node->as_array()->get(static_cast<std::size_t>(k)));
  return v;
}

}  // namespace

bool fits(const Key& key, const toml::node& node) {
  // No range holds nan, nor an infinity: its bounds are open there.
  const auto number_fits = [&](const toml::node& one) {
    return one.is_number() && key.range.holds(real_of(one));
  };
  const auto numbers_fit = [&](std::size_t count) {
    const auto* array = node.as_array();
    return array && array->size() == count &&
           std::all_of(array->begin(), array->end(), number_fits);
  };
  switch (key.type) {
    case KeyType::boolean:
      return node.is_boolean();
    case KeyType::reals:
      return node.is_array() && !node.as_array()->empty() && numbers_fit(node.as_array()->size());
    case KeyType::integer:
      return node.is_integer() && number_fits(node);
    case KeyType::real:
      return number_fits(node);
    case KeyType::real3:
      return numbers_fit(3);
    case KeyType::real4:
      return numbers_fit(4);
    case KeyType::path:
      return is_path(node);
    case KeyType::paths: {
      const auto* list = node.as_array();
      return is_path(node) ||
             (list && !list->empty() && std::all_of(list->begin(), list->end(), is_path));
    }
    case KeyType::words: {
      const auto* list = node.as_array();
      const auto is_choice = [&](const toml::node& one) {
        return one.is_string() && is_among(one.ref<std::string>(), key.choices);
      };
      return list && !list->empty() && std::all_of(list->begin(), list->end(), is_choice);
    }
    case KeyType::text: {
      if (!node.is_string()) return false;
      const std::string& text = node.ref<std::string>();
      return key.choices.empty() ? is_name(text) : is_among(text, key.choices);
    }
  }
  return false;
}

std::string short_text(double x) { return tables::rounded_text(x, 3); }

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

std::string text_of(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_floating_point()) return text_of(*node.value<double>());
  if (const auto* array = node.as_array()) {
    if (array->is_array_of_tables()) return "a list of tables";
    std::string items;
    for (const toml::node& item : *array) items += (items.empty() ? " " : ", ") + text_of(item);
    return "[" + items + (items.empty() ? "]" : " ]");
  }
  std::ostringstream out;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) out << value;
  });
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string Source::file_of(const toml::source_region& place) const {
  return place.path ? *place.path : name_;
}

std::string Source::at(const toml::source_region& place) const {
  const std::string file = file_of(place);
  return file.starts_with(kSetOption) ? file : file + ":" + std::to_string(place.begin.line);
}

void Source::fail(const toml::source_region& place, const std::string& message) const {
  throw SceneError(one_line(at(place) + ": " + message));
}

void Source::fail(const std::string& message) const {
  throw SceneError(one_line(name_ + ":1: " + message));
}

Section::Section(const Source& source, const toml::table& table, std::string path,
                 std::string_view section, std::string_view kind, const toml::table* base)
    : source_(source),
      table_(table),
      path_(std::move(path)),
      section_(section),
      kind_(kind),
      base_(base) {
  for (const auto& [name, node] : table_) check(name, node);
  for (const Key& key : scene_keys())
    if (applies(key) && key.required() && !find(key.name)) fail_missing(key.name);
}

void Section::fail(std::string_view name, const std::string& allowed) const {
  const toml::node& node = *find(name);
  source_.fail(node.source(), label(name) + " = " + text_of(node) + ": " + allowed);
}

void Section::fail_missing(std::string_view name) const {
  for (const Key& key : scene_keys())
    if (applies(key) && key.name == name)
      source_.fail(table_.source(), label(name) + " is missing: " + allowed_values(key));
  source_.fail(table_.source(), label(name) + " is missing");
}

void Section::refuse(std::string_view name, std::int64_t value, const std::string& allowed) const {
  if (has(name)) fail(name, allowed);
  source_.fail(table_.source(), label(name) + " = " + std::to_string(value) + ": " + allowed);
}

double Section::real(std::string_view name) const {
  const toml::node* node = find(name);
  return node ? real_of(*node) : std::stod(std::string(fallback(name)));
}

std::optional<double> Section::optional_real(std::string_view name) const {
  return has(name) ? std::optional(real(name)) : std::nullopt;
}

std::int64_t Section::integer(std::string_view name) const {
  const toml::node* node = find(name);
  return node ? *node->value<std::int64_t>() : std::stoll(std::string(fallback(name)));
}

std::optional<std::int64_t> Section::optional_integer(std::string_view name) const {
  return has(name) ? std::optional(integer(name)) : std::nullopt;
}

bool Section::boolean(std::string_view name) const {
  const toml::node* node = find(name);
  return node ? node->ref<bool>() : fallback(name) == "true";
}

std::vector<double> Section::reals(std::string_view name) const {
  std::vector<double> numbers;
  if (const toml::node* node = find(name))
    for (const toml::node& one : *node->as_array()) numbers.push_back(real_of(one));
  return numbers;
}

std::vector<std::string> Section::words(std::string_view name) const {
  std::vector<std::string> found;
  if (const toml::node* node = find(name))
    for (const toml::node& one : *node->as_array()) found.push_back(one.ref<std::string>());
  return found;
}

std::string Section::text(std::string_view name, std::string_view otherwise) const {
  const toml::node* node = find(name);
  return node ? node->ref<std::string>() : std::string(otherwise);
}

std::optional<Vec3> Section::optional_real3(std::string_view name) const {
  return vector_of<Vec3>(find(name));
}

std::optional<Eigen::Vector4d> Section::optional_real4(std::string_view name) const {
  return vector_of<Eigen::Vector4d>(find(name));
}

bool Section::applies(const Key& key) const {
  return key.section == section_ && (kind_.empty() || is_among(kind_, key.kinds));
}

std::string Section::label(std::string_view name) const {
  return path_.empty() ? std::string(name) : path_ + "." + std::string(name);
}

void Section::check(const toml::key& name, const toml::node& node) const {
  if (section_.empty() && is_among(name.str(), kSceneSections)) return;
  std::string names;
  for (const Key& key : scene_keys()) {
    if (!applies(key)) continue;
    if (key.name == name.str()) {
      if (fits(key, node)) return;
      fail(key.name, allowed_values(key));
    }
    names += (names.empty() ? "" : ", ") + std::string(key.name);
  }
  if (section_ == "contact" && !base_ && node.is_table()) return;  // a pair
  if (section_.empty())
    for (const char c : " " + std::string(kSceneSections))
      names += c == ' ' ? ", " : std::string(1, c);
  source_.fail(name.source(), label(name.str()) + ": no such key" +
                                  (kind_.empty() ? "" : " in a stage of this kind") +
                                  "; allowed are " + names);
}

const toml::node* Section::find(std::string_view name) const {
  const toml::node* node = table_.get(name);
  return node || !base_ ? node : base_->get(name);
}

std::string_view Section::fallback(std::string_view name) const {
  const auto keys = scene_keys();
  return std::find_if(keys.begin(), keys.end(),
                      [&](const Key& key) { return applies(key) && key.name == name; })
      ->fallback;
}

const toml::array& tables_of(const Source& source, const toml::node& node,
                             const std::string& name) {
  const toml::array* list = node.as_array();
  if (!list || !list->is_homogeneous<toml::table>())
    source.fail(node.source(),
                name + " = " + text_of(node) + ": a list of [[" + name + "]] tables");
  return *list;
}

Section section_of(const Source& source, const toml::array& tables, const std::string& name,
                   std::size_t k) {
  return {source, *tables.get(k)->as_table(), name + "[" + std::to_string(k) + "]", name};
}

}  // namespace tangency::inline v0::dem
