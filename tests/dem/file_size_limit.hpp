// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A full disk, as far as a test can have one.
#pragma once

#include <sys/resource.h>

#include <csignal>

namespace tangency::testing {

/// As on a full disk: no file grows beyond `bytes` while this lives, in tools started here too.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : action_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, action_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*action_)(int);
  rlimit before_{};
};

}  // namespace tangency::testing
