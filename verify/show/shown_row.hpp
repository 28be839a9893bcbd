// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// One row of a corpus as it is shown: its inputs, its truth and an answer to it, as cells.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

/// Name and text of the cells that are not empty, in the order of the header.
using Cells = std::vector<std::pair<std::string, std::string>>;

/// The cells of input row `row`, and the line where they stand. Nothing where there is no such row.
/// Throws tables::Error for a table that cannot be read.
struct InputRow {
  Cells cells;
  std::size_t line;
};
std::optional<InputRow> input_row(const tables::NamedText& inputs, std::size_t row);

/// The lines of which one of these columns says `row`: of a truth one for every normal, of answers
/// what was answered, of lists of neighbours the pairs of a body. Lines that cannot be read are
/// left out.
std::vector<Cells> lines_about(tables::Reader&& table, std::size_t row,
                               const std::vector<std::string>& columns = {"row"});

/// Two solids; of ellipses with z = 0 and a third semi-axis along z.
struct Solids {
  RawEllipsoid a, b;
};

/// What a.x to b.qz, or a.x to b.uy of ellipses, mean. Nothing where the cells are of another kind
/// or are no bodies.
std::optional<Solids> solids_of(const Cells& inputs);

}  // namespace tangency::inline v0::verify
