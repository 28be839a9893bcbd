// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/view/sample_view.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <system_error>
#include <vector>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/contact_frames.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/dem/tool/vtk_file.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace fs = std::filesystem;
using tables::to_text;

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[at + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

fs::path file_of(const fs::path& directory, std::int64_t cycle, const std::string& ending) {
  return directory / "frames" / (to_text(cycle) + ending);
}

/// Frames that are there, of those that the index lists, and their sizes in bytes.
struct Listed {
  VtkEntry entry;
  std::size_t size;
};
std::vector<Listed> listed_frames(const fs::path& directory) {
  std::vector<Listed> all;
  std::ifstream index(directory / "frames.pvd");
  for (const VtkEntry& entry : vtk_entries(index, "frames", ".vtp")) {
    std::size_t size = 0;
    for (const char* ending : {".vtp", ".chains.vtp"}) {
      std::error_code missing;
      const auto bytes = fs::file_size(file_of(directory, entry.cycle, ending), missing);
      if (!missing) size += bytes;
    }
    if (size > 0) all.push_back({entry, size});
  }
  return all;
}

/// As many as fit, evenly spread, with the first and the last; the last alone where two do not.
std::vector<VtkEntry> chosen_frames(const std::vector<Listed>& all) {
  for (std::size_t count = all.size(); count > 0; --count) {
    std::vector<VtkEntry> chosen;
    std::size_t size = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t last = all.size() - 1;
      const Listed& frame = all[count == 1 ? last : k * last / (count - 1)];
      chosen.push_back(frame.entry);
      size += frame.size;
    }
    if (size <= kMostFrameBytes) return chosen;
  }
  return {};
}

std::string script_of(const VtkEntry& entry, const char* kind, std::string_view bytes) {
  return std::string("<script type=\"text/plain\" class=\"frame\" data-kind=\"") + kind +
         "\" data-cycle=\"" + to_text(entry.cycle) + "\" data-time=\"" + to_text(entry.time) +
         "\">" + base64(bytes) + "</script>\n";
}

/// The contacts of final.state, where it is of this cycle; nothing where it cannot be read.
std::optional<std::string> chains_at_the_end(const fs::path& directory, std::int64_t cycle) {
  const fs::path file = directory / "final.state";
  if (cycle_of_state(file) != cycle) return std::nullopt;
  try {
    const State state = load_state(file);
    return chains_vtp(state, packing_of(state));
  } catch (const StateError&) {
    return std::nullopt;
  }
}

std::string note(const std::string& text) { return "<p class=\"note\">" + text + "</p>\n"; }

}  // namespace

std::string sample_view(const fs::path& directory, const Units& units) {
  const std::string head = "<section class=\"sample\" data-length=\"" + units.length +
                           "\" data-stress=\"" + units.stress + "\" data-time=\"" + units.time +
                           "\" data-force=\"" + units.force + "\"><h2>Sample</h2>\n",
                    end = "</section>\n";
  const std::vector<Listed> all = listed_frames(directory);
  if (all.empty())
    return head +
           note(
               "The run has no frames: <code>frame_interval</code> in <code>[output]</code> "
               "writes them, and then the sample is shown here.") +
           end;
  const std::vector<VtkEntry> chosen = chosen_frames(all);
  if (chosen.empty())
    return head +
           note("The frames are too large for a page: ParaView opens <code>frames.pvd</code>.") +
           end;
  std::string frames;
  bool any_chains = false;
  for (const VtkEntry& entry : chosen) {
    frames += script_of(entry, "particles",
                        read_whole(file_of(directory, entry.cycle, ".vtp")).value_or(""));
    auto chains = read_whole(file_of(directory, entry.cycle, ".chains.vtp"));
    any_chains = any_chains || chains.has_value();
    if (!any_chains && entry.cycle == chosen.back().cycle)
      chains = chains_at_the_end(directory, entry.cycle);
    if (chains) frames += script_of(entry, "chains", *chains);
  }
  std::string said;
  if (chosen.size() < all.size())
    said = note(to_text(chosen.size()) + " of " + to_text(all.size()) +
                " frames, evenly spread: the others would make the page too large. ParaView opens "
                "all of them, <code>frames.pvd</code>.");
  std::string page = head + said + end + frames + "<script>\n\"use strict\";\n";
  return page.append(view_script()) + "</script>\n";
}

}  // namespace tangency::inline v0::dem
