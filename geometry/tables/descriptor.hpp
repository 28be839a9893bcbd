// SPDX-License-Identifier: MIT
/// @file
/// A POSIX file descriptor that closes itself; the three standard ones stay open.
#pragma once

#include <unistd.h>

#include <utility>

namespace tangency::csv {

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

}  // namespace tangency::csv
