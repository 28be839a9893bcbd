// SPDX-License-Identifier: MIT
/// @file
/// A scene's file before it is checked: with what it includes, keys that are set from outside, and
/// the combinations of its [sweep].
///
/// A file's `include` names others, from its own folder. Their tables are joined key by key, where
/// the file's own keys win over those of what it includes, and later files over earlier ones; their
/// lists of tables ([[stage]], [[wall]], [[body]]) stand before its own. Messages name the file and
/// line that a key stands in.
///
/// (1) Settings are as if the file had them: checked by the same table, refused by the same words.
/// (2) text() reads back to the same scene.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/scene/scene_error.hpp>
#include <tangency/dem/scene/scene_model.hpp>

namespace tangency::inline v0::dem {

/// Keys that get one value: "contact.friction_coefficient", "stage.shear.mean_stress" by the
/// stage's name, "stage[2].duration" by its place from 0, several between commas.
struct Setting {
  std::string keys;   ///< as written
  std::string value;  ///< as TOML writes it
};

/// One key of [sweep], or several that go together, and the values that they take.
struct SweepAxis {
  std::string keys;                 ///< as a Setting has them
  std::vector<std::string> values;  ///< as TOML writes them, in the file's order
  std::string file;                 ///< where they stand
  std::size_t line;                 ///< where they stand
};

/// The [sweep] of a scene.
struct Sweep {
  std::vector<SweepAxis> axes;       ///< in the file's order
  std::optional<std::string> after;  ///< the stage up to which combinations have one run

  /// The product of the numbers of values.
  std::size_t combinations() const;
  /// Of each axis a value, the last axis changing first.
  std::vector<Setting> combination(std::size_t index) const;
};

/// A scene's text with what it includes, and its keys as they are set since.
class SceneFile {
 public:
  /// @throws SceneError  for a file that cannot be read or is no TOML, and for an include of these
  explicit SceneFile(const std::filesystem::path& file);
  /// The same from text; `name` stands for the file in messages, and its folder is looked in for
  /// what it includes.
  SceneFile(const std::string& text, const std::string& name);
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;             ///< takes over another's text
  SceneFile& operator=(SceneFile&&) noexcept;  ///< the same

  /// The same text read anew, without what was set since.
  SceneFile again() const;

  /// Sets keys from the command line: "KEY[,KEY...]=VALUE". A value that is no TOML is a text.
  /// @throws SceneError  "--set KEY=VALUE: ..."
  Setting set(const std::string& assignment);
  /// Sets keys to a value that stands in line `line` of a file.
  void set(const Setting& setting, const std::string& file, std::size_t line);

  /// None where the file has no [sweep].
  /// @throws SceneError
  std::optional<Sweep> sweep() const;

  /// Ends the run behind the stage of that name.
  /// @throws SceneError  where there is none, or more than one
  void end_after(const std::string& stage);
  /// Leaves out one of kSceneSections.
  void drop(const std::string& section);

  /// @param shapes  of a table of bodies that has their semi-axes
  /// @throws SceneError  where it breaks the schema
  Scene scene(const BodyShapes& shapes = {}) const;

  /// All of it but include and [sweep], as one file of TOML to be put into `folder`: names of other
  /// files lead there from that folder.
  std::string text(const std::filesystem::path& folder) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace tangency::inline v0::dem
