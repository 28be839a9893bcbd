// SPDX-License-Identifier: MIT
/// @file
/// The sample in space, as a part of a report's page that turns under the hand. The page holds the
/// files of frames as they are (frames.hpp) and the programs of dem/tool/view, which read and draw
/// them: nothing else is needed to look at it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include <tangency/dem/scene/units.hpp>

namespace tangency::inline v0::dem {

/// Bytes of frames that a page holds at most, before base64 makes a third more of them. Chosen: a
/// page of 32 MB is still opened by a telephone; 10,000 bodies take 1.2 MB a frame.
inline constexpr std::size_t kMostFrameBytes = 24'000'000;

/// HTML for a page's body. Of more frames than the page may hold it takes ones that are evenly
/// spread, the last one always; where a frame alone is larger, or there is none, a line that says
/// so, and then no program. Force chains are those of the frames; the last frame has those of
/// final.state, where no frame has any and both are of one cycle.
/// @param directory  of a run
/// @param units      that numbers are named with; empty names where there are none
std::string sample_view(const std::filesystem::path& directory, const Units& units);

/// Style of the view, for the head of its page, and its programs, which sample_view() brings.
std::string_view view_style();
std::string_view view_script();

}  // namespace tangency::inline v0::dem
