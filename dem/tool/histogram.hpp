// SPDX-License-Identifier: MIT
/// @file
/// The table that `tangency-dem micro --histogram` writes: how contacts, forces and branches are
/// spread over directions, and what the models of orders 2 and 4 say.
#pragma once

#include <string>

#include <tangency/dem/tool/micro_summary.hpp>
#include <tangency/dem/tool/packing.hpp>

namespace tangency::inline v0::dem {

/// CSV, a row a class of the partition. Means of a class without contacts, and models that are not
/// defined, are empty cells.
/// @param packing  in space
///
/// (1) E times area adds up to 1 over all classes, and sides to twice the contacts
std::string histogram_csv(const Packing& packing, const MicroSummary& summary);

}  // namespace tangency::inline v0::dem
