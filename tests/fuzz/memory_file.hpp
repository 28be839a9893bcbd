// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files in memory, which a reader opens by a path, and outputs of this process that go to them.
#pragma once

#include <string>

#include <tangency/tests/fuzz/target.hpp>

namespace tangency::testing::fuzz {

/// A regular file without a place in a folder; empty at first.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// By which this process may open it, for reading and for writing.
  const std::string& path() const { return path_; }
  int descriptor() const { return file_; }
  /// What it holds from now on.
  void set(Bytes bytes);
  std::string text() const;

 private:
  int file_;
  std::string path_;
};

/// While it lives, an output of the process, 1 or 2, goes to a file that is emptied first. Reports
/// of a sanitizer go where they went.
class Diverted {
 public:
  Diverted(int output, MemoryFile& to);
  ~Diverted();
  Diverted(const Diverted&) = delete;
  Diverted& operator=(const Diverted&) = delete;

 private:
  int output_, kept_;
};

}  // namespace tangency::testing::fuzz
