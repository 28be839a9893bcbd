// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::tables {
namespace {

using Names = std::vector<std::string>;

std::string refusal(const std::string& path) {
  try {
    const OutputFile file(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "opened";
}

TEST(OutputFile, AppearsOnCommitOnly) {
  const testing::TemporaryFolder folder;
  OutputFile file(folder.path("t.csv"));
  file.write("one\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path("t.csv")));
  file.commit();
  EXPECT_EQ(folder.names(), Names{"t.csv"});
  EXPECT_EQ(testing::read_file(folder.path("t.csv")), "one\n");
}

TEST(OutputFile, LeavesTheOldFileAndNothingElseWithoutCommit) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.write("t.csv", "old");
  {
    OutputFile file(path);
    file.write("new");
    EXPECT_EQ(folder.names().size(), 2U);
  }
  EXPECT_EQ(folder.names(), Names{"t.csv"});
  EXPECT_EQ(testing::read_file(path), "old");
}

TEST(OutputFile, ReplacesContentsAndKeepsPermissionsAndLink) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.write("t.csv", "old");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  std::filesystem::create_symlink("t.csv", folder.path("link.csv"));
  OutputFile file(folder.path("link.csv"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.csv")));
  EXPECT_EQ(testing::read_file(path), "new");
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0640));
}

TEST(OutputFile, TwoMayBeWrittenToOnePlaceAtATime) {
  const testing::TemporaryFolder folder;
  OutputFile first(folder.path("t.csv"));
  OutputFile second(folder.path("t.csv"));
  first.write("first");
  second.write("second");
  second.commit();
  first.commit();
  EXPECT_EQ(folder.names(), Names{"t.csv"});
  EXPECT_EQ(testing::read_file(folder.path("t.csv")), "first");
}

TEST(OutputFile, NamedPipeIsWrittenToDirectly) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.path("pipe");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const Descriptor reader(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  OutputFile file(path);
  file.write("now");
  std::array<char, 8> got{};
  EXPECT_EQ(::read(reader.get(), got.data(), got.size()), 3);
  EXPECT_STREQ(got.data(), "now");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_fifo(path));
  EXPECT_EQ(folder.names(), Names{"pipe"});
}

TEST(OutputFile, NamesWhatItCannotWrite) {
  EXPECT_EQ(refusal("/nonexistent/t.csv"),
            "/nonexistent/t.csv: cannot be written: No such file or directory");
  EXPECT_EQ(refusal("/"), "/: cannot be written: Is a directory");
}

TEST(OutputFile, RefusesTheNinthAtOnceAndTakesItLater) {
  const testing::TemporaryFolder folder;
  std::vector<std::unique_ptr<OutputFile>> files;
  for (int i = 0; i < 8; ++i) {
    files.push_back(std::make_unique<OutputFile>(folder.path(std::to_string(i))));
  }
  EXPECT_EQ(refusal(folder.path("8")),
            folder.path("8") + ": cannot be written: Too many open files");
  files.pop_back();
  EXPECT_EQ(refusal(folder.path("8")), "opened");
}

}  // namespace
}  // namespace tangency::tables
