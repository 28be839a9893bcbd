// SPDX-License-Identifier: MIT
#include <tangency/dem/scene.hpp>

#include <tangency/dem/scene/scene_file.hpp>

namespace tangency::inline v0::dem {

Scene parse_scene(const std::string& text, const std::string& name) {
  return SceneFile(text, name).scene();
}

Scene load_scene(const std::filesystem::path& file) { return SceneFile(file).scene(); }

}  // namespace tangency::inline v0::dem
