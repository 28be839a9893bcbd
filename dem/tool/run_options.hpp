// SPDX-License-Identifier: MIT
/// @file
/// What tangency-dem run was asked for.
#pragma once

#include <filesystem>
#include <optional>

namespace tangency::inline v0::dem {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path out;
  std::optional<std::filesystem::path> resume;
  int threads = 0;  ///< 0: as many as set_threads(0) of dem/parallel.hpp takes
  bool quiet = false;
  bool replace = false;       ///< take away the results of another run
  bool profile = false;       ///< say where the time of the cycles went
  bool reproducible = false;  ///< the same bits on every machine
  bool verify = false;        ///< check every cycle (dem/verification.hpp)
};

}  // namespace tangency::inline v0::dem
