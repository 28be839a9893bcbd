// SPDX-License-Identifier: MIT
/// @file
/// Frames to look at. Particles are drawn where they lie in the cell, wrapped into it.
///
/// DIR/frames.pvd (ParaView) lists DIR/frames/CYCLE.vtp: points with `orientation` (x y z w),
/// `semi_axes`, `velocity`, `type`, `contacts` and the tensor `axes` = R diag(2a) R', which the
/// filter Tensor Glyph draws to scale as its sphere of diameter 1; field data `cell`, its three
/// edge vectors. DIR/frames.xyz (OVITO) is extended XYZ under OVITO's names: `orientation` x y z w
/// and `aspherical_shape`, the three semi-axes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <tangency/dem/simulation.hpp>
#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::dem {

class Frames {
 public:
  /// Starts after the frames that the directory holds already.
  /// @param last_cycle  frames of later cycles are taken away; -1: all are
  /// @param adds        else add() does nothing, and where no frame is kept there are no files
  /// @throws WriteError  all frames are still there
  Frames(const std::filesystem::path& directory, std::int64_t last_cycle, bool adds);

  /// Adds one frame, if any are to be; a second one of the same cycle is left out.
  /// @throws WriteError
  void add(const Simulation& simulation);

  /// Gives frames.xyz, until now frames.xyz.part, its name.
  /// @throws WriteError
  void finish();

 private:
  struct Entry {
    std::int64_t cycle;
    double time;
  };
  /// Reads the entries up to a cycle; returns those of later ones.
  std::vector<Entry> read_index(std::int64_t last_cycle);
  void keep_xyz(std::int64_t last_cycle);
  std::string index_text() const;
  bool holds_any() const;

  std::filesystem::path directory_;
  bool adds_;
  tables::Descriptor xyz_;  // frames.xyz.part
  std::vector<Entry> entries_;
};

}  // namespace tangency::inline v0::dem
