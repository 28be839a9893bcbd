// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Text of any origin inside XML, HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace tangency::inline v0::verify {

/// `text` as UTF-8 that XML 1.0 can hold, in elements and in quoted attributes. What is no UTF-8 or
/// no character of XML becomes `?`; a line's end and a tab stay.
std::string escaped(std::string_view text);

}  // namespace tangency::inline v0::verify
