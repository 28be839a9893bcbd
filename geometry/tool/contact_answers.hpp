// SPDX-License-Identifier: MIT
/// @file
/// What `tangency contact` answers to a pair, by each of its methods.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/tables/row_stream.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/contact_columns.hpp>

namespace tangency::inline v0::tool {

using ContactColumns = FurtherColumns<ContactRow>;

/// Those that every row has.
inline constexpr std::array<std::string_view, 15> kContactColumns{
    "row",  "relation", "gap",  "nx",   "ny",        "nz",     "pa.x", "pa.y",
    "pa.z", "pb.x",     "pb.y", "pb.z", "gap_error", "status", "inner"};

/// Definitions of contact; the first is the default.
std::vector<std::string> contact_methods();

/// Rows of a table of pairs by a method, one of contact_methods().
tables::BindRows bind_contact(std::string_view method, MixedTerms mixed_terms,
                              const ContactColumns& further);

}  // namespace tangency::inline v0::tool
