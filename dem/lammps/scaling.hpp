// SPDX-License-Identifier: GPL-2.0-or-later
/// @file
/// How long a step of many particles takes on many ranks: a model on paper, with what was measured
/// on one machine and assumed of others.
///
/// A rank has n = particles / ranks of its own in a cube, and as ghosts what lies within a halo
/// around it, h mean distances of particles in all across each edge: (n^(1/3) + h)^3 - n. A step is
///     n t_own + g t_ghost                            its particles, and bodies of ghosts
///     + 4 variation sqrt(n) t_own                    what the slowest rank has more, 4 sigma
///     + g bytes (leaving ranks/node + passes...)     over the wire of a node, and by memory
///     + messages latency + 2 levels latency          halos, and two sums over all ranks
/// The efficiency is n t_own over it. Not in it: noise of the system, the memory bandwidth of full
/// nodes, and output.
#pragma once

#include <cstddef>

namespace tangency::inline v0::lammps {

/// Times in seconds, sizes in bytes. Defaults: measured on 64,000 spheroids, b/a = 0.7, on one core
/// by an earlier trial, whose bodies were dearer than those of this program, or assumed, as each
/// line says.
struct ScalingModel {
  double own = 1.05e-6;    ///< an own particle and step; measured: pair 0.85, move 0.18, lists 0.02
  double ghost = 0.25e-6;  ///< the body of a ghost; measured; some 0.05 where bodies are columns
  double halo = 2.82;      ///< h; 2 (2 a_max + skin) over the mean distance, a random packing
  double ghost_bytes = 152;  ///< a ghost and step: 104 there, 48 back; counted
  double node_ranks = 128;   ///< ranks a node; assumed
  double leaving = 0.21;     ///< share of the halos that leaves a node; blocks of 4 x 4 x 8 ranks
  double node_bandwidth = 25e9;  ///< bytes a second of a node's wire; assumed
  double copy_bandwidth = 5e9;   ///< of a rank's copies in memory; assumed
  double copies = 3;             ///< times that a byte is copied; assumed
  double latency = 2e-6;         ///< of a message, and of a level of a sum; assumed
  double messages = 12;          ///< a step, of six neighbours there and back; counted
  double variation = 0.5;        ///< of the work of a particle, relative; measured
  double bytes = 2300;           ///< of memory a particle; estimated from LAMMPS' own account
};

/// What a step costs.
struct ScalingRow {
  double own_per_rank = 0.0;    ///< n
  double ghosts_per_own = 0.0;  ///< g / n
  double step = 0.0;            ///< s
  double efficiency = 0.0;      ///< in (0, 1]
  double bytes_per_rank = 0.0;  ///< of memory, ghosts included
  const char* bounded_by = "";  ///< the largest part of what is no work on own particles
};

/// Requires particles >= ranks >= 1. One rank sends nothing and waits for nobody.
///
/// (1) more particles on as many ranks are more efficient
ScalingRow scaled(const ScalingModel& model, double particles, double ranks);

}  // namespace tangency::inline v0::lammps
