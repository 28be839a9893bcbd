// SPDX-License-Identifier: MIT
/// @file
/// GSD files, version 2 of the file layer, schema hoomd 1.4: one frame of a sample written, any
/// frame read. Numbers have 32 bits there: what is read back is rounded to float.
///
/// A header of 256 bytes names the places of an index, 32 bytes a chunk, and of a list of names
/// that end in 0. A chunk is an array; one that a frame lacks is that of frame 0, or the schema's
/// default. Little-endian.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <tangency/dem/tool/exchange_sample.hpp>

namespace tangency::inline v0::dem {

/// Radii as type_shapes of class Ellipsoid, one type for each shape of each type; orientations w x
/// y z; angular momenta as quaternions; the box has its centre at the origin, and particles lie in
/// it.
/// @param sample  of a cell as with_triangular_cell() has them
std::string gsd_file(const Sample& sample);

/// Does a text begin as a GSD file?
bool is_gsd(std::string_view bytes);

/// @param frame  from 0; without: the last one
/// @throws tables::Error  what is no GSD file of schema hoomd, is cut off, or has shapes other than
///                        Ellipsoid and Sphere
Sample read_gsd(const std::string& file, std::string_view bytes, std::optional<int> frame);

}  // namespace tangency::inline v0::dem
