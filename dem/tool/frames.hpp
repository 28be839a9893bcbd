// SPDX-License-Identifier: MIT
/// @file
/// Frames to look at. Particles are drawn where they lie in the cell, wrapped into it.
///
/// DIR/frames.pvd (ParaView) lists DIR/frames/CYCLE.vtp: points with `orientation` (x y z w),
/// `semi_axes`, `velocity`, `type`, `contacts` and, of 32 bits, the tensor `axes` = R diag(2a) R',
/// which the filter Tensor Glyph draws to scale as its sphere of diameter 1; field data `cell`, its
/// three edge vectors, and, of scenes with [[wall]], `walls`, a normal out of each and the offset
/// of its face along it. DIR/frames.xyz (OVITO) is extended XYZ under OVITO's names: `orientation`
/// x y z w, `aspherical_shape`, the three semi-axes, and `id`, from 1.
/// Of the plane there is the field data `dimensions`, 2.
///
/// With contacts DIR/contacts.pvd lists DIR/frames/CYCLE.contacts.vtp, DIR/chains.pvd
/// DIR/frames/CYCLE.chains.vtp, and for OVITO each cycle has DIR/frames/CYCLE.bonds:
/// contact_frames.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/vtk_file.hpp>
#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::dem {

class Frames {
 public:
  /// Starts after the frames that the directory holds already.
  /// @param last_cycle  frames of later cycles are taken away; -1: all are
  /// @param adds        else add() does nothing, and where no frame is kept there are no files
  /// @param adds_contacts  with frames: those of contacts too
  /// @throws WriteError  all frames are still there
  Frames(const std::filesystem::path& directory, std::int64_t last_cycle, bool adds,
         bool adds_contacts);

  /// Adds one frame, if any are to be; what is there of the same cycle is left out: a disk that was
  /// full may have left a part.
  /// @throws WriteError
  void add(const Simulation& simulation);

  /// Gives frames.xyz, until now frames.xyz.part, its name.
  /// @throws WriteError
  void finish();

 private:
  /// Files of one kind, one a cycle, and their index.
  struct Kind {
    std::string index, ending;
    bool has_bonds = false;           ///< a file of bonds beside each
    std::vector<VtkEntry> entries{};  ///< those that are kept or were added
  };
  /// Reads the entries up to a cycle; returns those of later ones.
  std::vector<VtkEntry> read_index(Kind& kind, std::int64_t last_cycle) const;
  void keep_xyz(std::int64_t last_cycle);
  std::string index_of(const Kind& kind) const;
  std::filesystem::path file_of(const Kind& kind, std::int64_t cycle) const;
  std::filesystem::path bonds_of(std::int64_t cycle) const;
  static bool has(const Kind& kind, std::int64_t cycle);
  void add_to(Kind& kind, const State& state, const std::string& file);
  bool holds_any() const;

  std::filesystem::path directory_;
  bool adds_, adds_contacts_;
  tables::Descriptor xyz_;       // frames.xyz.part
  std::int64_t xyz_cycle_ = -1;  ///< of its last whole frame
  std::array<Kind, 3> kinds_{{{"frames.pvd", ".vtp"},
                              {"contacts.pvd", ".contacts.vtp", true},
                              {"chains.pvd", ".chains.vtp"}}};
};

}  // namespace tangency::inline v0::dem
