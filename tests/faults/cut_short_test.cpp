// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs that cannot write one file, and go on when they can.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "../dem/scenes.hpp"
#include "../tool/process.hpp"

namespace tangency::testing {
namespace {

namespace fs = std::filesystem;

std::string scene_text() {
  return with(small_scene(), "frame_interval = 1000000\n",
              "frame_interval = 100\ncontact_frames = true\ncontact_interval = 100\n");
}

/// Every file of a run but summary.json, which has times.
std::map<std::string, std::string> contents(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != "summary.json")
      files[fs::relative(entry.path(), folder).string()] = read_file(entry.path().string());
  return files;
}

/// A run that ended where it could not write a file of cycle 100: its name was taken.
class CutShort {
 public:
  explicit CutShort(const std::string& file)
      : scene_(folder_.write("scene.toml", scene_text())), out_(folder_.path("out")) {
    fs::create_directories(out_ + "/" + file + ".part");
    const Finished run = run_tool({"run", scene_, "--out", out_, "--quiet"});
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find(file + ": cannot be written: Is a directory\n"), run.err.npos)
        << run.err;
    fs::remove(out_ + "/" + file + ".part");
  }

  std::string path(const std::string& file) const { return out_ + "/" + file; }
  std::map<std::string, std::string> resumed() const {
    const Finished run =
        run_tool({"run", scene_, "--out", out_, "--quiet", "--resume", path("checkpoint.state")});
    EXPECT_EQ(run.status, 0) << run.err;
    return contents(out_);
  }

 private:
  TemporaryFolder folder_;
  std::string scene_, out_;
};

std::map<std::string, std::string> undisturbed() {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", scene_text());
  EXPECT_EQ(run_tool({"run", scene, "--out", folder.path("out"), "--quiet"}).status, 0);
  return contents(folder.path("out"));
}

TEST(CutShort, RunsMakeUpForWhatAFrameStillNeeds) {
  const auto wanted = undisturbed();
  ASSERT_TRUE(wanted.contains("frames/100.chains.vtp"));
  for (const char* file : {"frames/100.bonds", "frames/100.contacts.vtp", "frames/100.chains.vtp",
                           "frames/100.vtp", "contacts/100.csv"})
    EXPECT_EQ(CutShort(file).resumed(), wanted) << file;
}

TEST(CutShort, FramesOfAllCyclesInOneFileAreWrittenAgainFromTheFirstThatIsNotWhole) {
  const auto wanted = undisturbed();
  for (const std::uintmax_t missing : {1U, 2U, 700U}) {
    const CutShort run("contacts/100.csv");
    const std::string frames = run.path("frames.xyz");
    fs::resize_file(frames + ".part", fs::file_size(frames + ".part") - missing);
    EXPECT_EQ(run.resumed(), wanted) << missing;
  }
}

}  // namespace
}  // namespace tangency::testing
