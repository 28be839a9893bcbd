// SPDX-License-Identifier: MIT
/// @file
/// The columns that particle_lanes.hpp computes with, of particles.
#pragma once

#include <tangency/dem/lanes/particle_lanes.hpp>
#include <tangency/dem/particles.hpp>

namespace tangency::inline v0::detail {

/// The columns of particles on which nothing acts, and of those on which `resultants` do. Valid as
/// long as no column changes its length.
ParticleColumns columns_of(const dem::Particles& particles);
ParticleColumns columns_of(const dem::Particles& particles, const dem::Resultants& resultants);
MovedColumns moved_columns_of(dem::Particles& particles);

}  // namespace tangency::inline v0::detail
