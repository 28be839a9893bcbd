// SPDX-License-Identifier: GPL-3.0-or-later
/// The sample in a report's page: which frames it holds, byte for byte. What a browser makes of
/// them is the longer check `view`.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../tool/process.hpp"
#include "scenes.hpp"

namespace tangency::testing {
namespace {

/// RFC 4648, by the digits' places.
std::string bytes_of_base64(std::string_view text) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t held = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    held = held << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> bits & 0xff);
  }
  return bytes;
}

/// The files that a page holds, by kind and cycle.
std::map<std::pair<std::string, std::string>, std::string> frames_in(const std::string& page) {
  std::map<std::pair<std::string, std::string>, std::string> frames;
  const auto after = [&](const std::string& mark, std::size_t& at, char end) {
    const std::size_t from = page.find(mark, at) + mark.size();
    at = page.find(end, from);
    return page.substr(from, at - from);
  };
  for (std::size_t at = 0;
       (at = page.find("<script type=\"text/plain\" class=\"frame\"", at)) != std::string::npos;) {
    const std::string kind = after("data-kind=\"", at, '"'),
                      cycle = after("data-cycle=\"", at, '"');
    frames[{kind, cycle}] = bytes_of_base64(after(">", at, '<'));
  }
  return frames;
}

/// A scene of which nothing but the first frame is computed: it places, and that is all.
std::string placing_scene() {
  const std::string whole = small_scene();
  return whole.substr(0, whole.find("[[stage]]\nkind = \"compress\"")) +
         "[output]\nframe_interval = 100\n";
}

std::string page_of(const std::string& directory) {
  const Finished report = run_tool({"report", directory});
  EXPECT_EQ(report.status, 0) << report.err;
  return read_file(directory + "/report.html");
}

/// Frames that are as large as is said, and hold nothing, in place of a run's own.
void write_frames(const TemporaryFolder& folder, std::size_t count, std::uintmax_t size) {
  std::string index;
  for (std::size_t k = 0; k < count; ++k) {
    const std::string name = "frames/" + std::to_string(k) + ".vtp";
    index += "<DataSet timestep=\"0.5\" part=\"0\" file=\"" + name + "\"/>\n";
    std::filesystem::resize_file(folder.write("out/" + name, ""), size);
  }
  folder.write("out/frames.pvd", index);
  std::filesystem::remove(folder.path("out/frames/0.chains.vtp"));
}

TEST(SampleView, HoldsTheFramesOfTheRunByteForByte) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out");
  const std::string scene = with(small_scene(), "frame_interval = 1000000",
                                 "frame_interval = 1000000\ncontact_frames = true");
  ASSERT_EQ(run_tool({"run", folder.write("scene.toml", scene), "--out", out, "--quiet"}).status,
            0);
  const auto frames = frames_in(page_of(out));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(out + "/frames")) {
    const std::string name = entry.path().filename().string();
    const std::string cycle = name.substr(0, name.find('.')), ending = name.substr(cycle.size());
    if (ending != ".vtp" && ending != ".chains.vtp") continue;
    ++files;
    const auto frame = frames.find({ending == ".vtp" ? "particles" : "chains", cycle});
    ASSERT_NE(frame, frames.end()) << name;
    EXPECT_EQ(frame->second, read_file(entry.path().string())) << name;
  }
  EXPECT_EQ(frames.size(), files);
  EXPECT_GE(files, 6u) << "the start and the ends of two stages, twice";
}

TEST(SampleView, TakesTheLastChainsFromTheStateWhereNoFrameHasAny) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out");
  ASSERT_EQ(
      run_tool({"run", folder.write("scene.toml", small_scene()), "--out", out, "--quiet"}).status,
      0);
  std::vector<std::string> with_chains;
  for (const auto& [key, text] : frames_in(page_of(out))) {
    if (key.first != "chains") continue;
    with_chains.push_back(key.second);
    EXPECT_NE(text.find("normal_force"), std::string::npos);
    EXPECT_EQ(text.find("NumberOfLines=\"0\""), std::string::npos) << "a pressed sample has some";
  }
  ASSERT_EQ(with_chains.size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(out + "/frames/" + with_chains[0] + ".vtp"));

  folder.write("out/final.state", "no state");
  EXPECT_EQ(frames_in(page_of(out)).count({"chains", with_chains[0]}), 0u);
}

TEST(SampleView, SaysWhereThereIsNoFrameAndBringsNoProgram) {
  const TemporaryFolder folder;
  const std::string scene = with(placing_scene(), "frame_interval = 100", "frame_interval = 0");
  const std::string out = folder.path("out");
  ASSERT_EQ(run_tool({"run", folder.write("scene.toml", scene), "--out", out, "--quiet"}).status,
            0);
  const std::string page = page_of(out);
  EXPECT_NE(page.find("The run has no frames"), std::string::npos);
  EXPECT_TRUE(frames_in(page).empty());
  EXPECT_EQ(page.find("<script"), std::string::npos) << "a program that has nothing to draw";
}

// The page draws their outlines: tests/browser/view_check.py.
TEST(SampleView, HoldsTheWallsOfTheSceneAndNoneWhereItHasNone) {
  const TemporaryFolder folder;
  const std::string walled =
      with(placing_scene(), "[cell]\n",
           "[cell]\nsize = [200.0, 200.0, 200.0]\nwalls = \"xyz\"\n[[wall]]\npoint = [0.0, 0.0, "
           "-1.0]\nnormal = [0.0, 0.0, 1.0]\n");
  for (const auto& [scene, walls] : {std::pair{placing_scene(), false}, {walled, true}}) {
    const std::string out = folder.path(walls ? "walled" : "periodic");
    const Finished run =
        run_tool({"run", folder.write("scene.toml", scene), "--out", out, "--quiet"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto frames = frames_in(page_of(out));
    const auto first = frames.find({"particles", "0"});
    ASSERT_NE(first, frames.end());
    const std::string& frame = first->second;
    EXPECT_EQ(frame.find("Name=\"walls\" NumberOfComponents=\"4\" NumberOfTuples=\"1\"") !=
                  std::string::npos,
              walls);
  }
}

TEST(SampleView, SpreadsItsFramesEvenlyWhereTheyAreTooManyAndSaysSo) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out");
  ASSERT_EQ(run_tool({"run", folder.write("scene.toml", placing_scene()), "--out", out, "--quiet"})
                .status,
            0);
  write_frames(folder, 9, 7'000'000);  // three of them fit into 24 MB
  const std::string page = page_of(out);
  std::vector<std::string> cycles;
  for (const auto& [key, text] : frames_in(page)) {
    cycles.push_back(key.second);
    EXPECT_EQ(text.size(), 7'000'000u);
  }
  EXPECT_EQ(cycles, (std::vector<std::string>{"0", "4", "8"}));
  EXPECT_NE(page.find("3 of 9 frames"), std::string::npos);

  write_frames(folder, 1, 25'000'000);
  const std::string too_large = page_of(out);
  EXPECT_NE(too_large.find("too large for a page"), std::string::npos);
  EXPECT_TRUE(frames_in(too_large).empty());
}

}  // namespace
}  // namespace tangency::testing
