// SPDX-License-Identifier: MIT
/// @file
/// What every reader of a scene throws.
#pragma once

#include <stdexcept>

namespace tangency::inline v0::dem {

/// A scene that cannot be run; what() is one line, "scene.toml:12: particles.p.count = -1: an
/// integer from 1 to 1000000".
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tangency::inline v0::dem
