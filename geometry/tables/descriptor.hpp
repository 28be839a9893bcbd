// SPDX-License-Identifier: MIT
/// @file
/// A POSIX file descriptor that closes itself, and the loop that writes to one. All of it is here,
/// so that a library which links no table uses it too.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <string_view>
#include <utility>

namespace tangency::inline v0::tables {

/// Closed at the latest with its scope; the three standard ones stay open.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) noexcept : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Descriptor() { close(); }

  int get() const noexcept { return value_; }
  bool is_open() const noexcept { return value_ >= 0; }
  /// False when the last data could not be stored; errno says why.
  bool close() noexcept {
    const int value = std::exchange(value_, -1);
    return value <= STDERR_FILENO || ::close(value) == 0;
  }

 private:
  int value_;
};

/// Writes all of the text. False where the rest cannot be written; errno says why.
inline bool write_all(int file, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace tangency::inline v0::tables
