// SPDX-License-Identifier: MIT
/// @file
/// The average strain of saved packings (micromechanics/average_strain.hpp): of the velocities at
/// one, by mechanism, and of the displacements since an older one, by what became of neighbours.
///
/// Nets are the polygons between contacts and the triangles of centres in the plane, the tetrahedra
/// of centres in space. As in all that this program prints compression is positive: tensors here
/// are minus velocity gradients and minus displacement gradients, in the axes of the scene.
///
/// Positions of a run are never put back into the cell: between two states of one run every
/// displacement is known, however far a particle or its image went. Velocities are those of the
/// half step before the state, and the rate that of the step.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/micromechanics/average_strain.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// What one net says; without a net `why_not` says why, and the rest is 0.
struct StrainOfNet {
  std::string name;  ///< "polygons", "triangles" or "tetrahedra"
  std::string why_not;
  std::size_t cells = 0, centres = 0, edges = 0;
  micromechanics::StrainParts parts;    ///< of velocities; extension positive
  micromechanics::StrainOfEdges since;  ///< of displacements; extension positive
};

struct StrainReport {
  std::string why_not;       ///< without any net: walls, or no particle
  Mat3 rate = Mat3::Zero();  ///< of the cell, extension positive
  std::vector<StrainOfNet> of_velocities;

  /// Of the displacements since the older state, on nets of that state.
  struct Since {
    std::int64_t cycle = 0;
    double time = 0.0;
    Mat3 gradient = Mat3::Zero();     ///< of the cell, F - I
    Mat3 logarithmic = Mat3::Zero();  ///< ln(F F')/2
    std::vector<StrainOfNet> nets;
  };
  std::optional<Since> since;
};

/// Of velocities.
StrainReport strain_report(const State& state, const Packing& packing);
/// Of velocities, and of displacements since `older`.
/// @param file  of the older state, for messages
/// @throws StateError  where the older state is not an earlier one of the same particles
StrainReport strain_report(const State& state, const Packing& packing, const State& older,
                           const std::string& file);

/// The section `average_strain`.
nlohmann::ordered_json strain_json(const StrainReport& report);
/// Lines of at most 100 characters.
std::string strain_table(const StrainReport& report);
/// What the help of the command says of both.
extern const char* const kStrainHelp;

}  // namespace tangency::inline v0::dem
