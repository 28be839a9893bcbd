// SPDX-License-Identifier: MIT
/// @file
/// `tangency contact --view ROW`: one pair of a table as a page that needs nothing beside it. It
/// shows both bodies, which turn under the hand, and what each method says of them, in the cells
/// that the table's rows have.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tangency/geometry/tables/row_stream.hpp>
#include <tangency/geometry/tool/body_columns.hpp>

namespace tangency::inline v0::tool {

struct ContactView {
  std::string input;   ///< the table; `-` or nothing: standard input
  std::string output;  ///< the page; nothing: pair-ROW.html here, which is said on standard error
  std::uint64_t row;   ///< of the data rows, from 0
  MixedTerms mixed_terms;
};

/// Writes the page; of the other rows of the table those before it are looked at alone.
/// @returns  what the row has by the common normal: answered or not
/// @throws tables::Error  a refused row, a row that is not there, a failed read or write
tables::ExitStatus write_contact_view(const ContactView& view);

/// Style and programs of the page.
std::string_view view_style();
std::string_view view_script();

}  // namespace tangency::inline v0::tool
