// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/styles.hpp>

#include <array>
#include <span>

#include <tangency/dem/lammps/compute_balance.hpp>
#include <tangency/dem/lammps/compute_fabric.hpp>
#include <tangency/dem/lammps/fix_contact_history.hpp>
#include <tangency/dem/lammps/fix_move.hpp>
#include <tangency/dem/lammps/fix_servo.hpp>
#include <tangency/dem/lammps/fix_wall.hpp>
#include <tangency/dem/lammps/pair_tangency.hpp>

namespace tangency::inline v0::lammps {
namespace {

/// What makes one, as LAMMPS wants it.
template <class Base, class Style, class... Words>
Base* made(LAMMPS_NS::LAMMPS* lammps, Words... words) {
  return new Style(lammps, words...);
}

template <class Style>
[[maybe_unused]] constexpr auto kPair = &made<LAMMPS_NS::Pair, Style>;
template <class Style>
[[maybe_unused]] constexpr auto kFix = &made<LAMMPS_NS::Fix, Style, int, char**>;
template <class Style>
[[maybe_unused]] constexpr auto kCompute = &made<LAMMPS_NS::Compute, Style, int, char**>;

// One line a style: its name, and the class of its header.
constexpr std::array kPairStyles{PairEntry{"tangency", kPair<PairTangency>}};
constexpr std::array kFixStyles{FixEntry{"NEIGH_HISTORY_TANGENCY", kFix<FixContactHistory>},
                                FixEntry{"tangency/move", kFix<FixMove>},
                                FixEntry{"tangency/servo", kFix<FixServo>},
                                FixEntry{"wall/tangency", kFix<FixWall>}};
constexpr std::array kComputeStyles{ComputeEntry{"tangency/balance", kCompute<ComputeBalance>},
                                    ComputeEntry{"tangency/fabric", kCompute<ComputeFabric>}};

}  // namespace

std::span<const PairEntry> pair_styles() { return kPairStyles; }
std::span<const FixEntry> fix_styles() { return kFixStyles; }
std::span<const ComputeEntry> compute_styles() { return kComputeStyles; }

}  // namespace tangency::inline v0::lammps
