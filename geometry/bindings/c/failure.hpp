// SPDX-License-Identifier: MIT
/// @file
/// How a call of the C interface fails: a refusal is thrown inside, and becomes a code and a
/// message of the calling thread at the border. Internal.
#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include <tangency/geometry/bindings/c/tangency.h>

namespace tangency::inline v0::c {

/// No row: of errors that none has.
inline constexpr std::size_t kNoRow = std::numeric_limits<std::size_t>::max();

class Refused : public std::runtime_error {
 public:
  Refused(int code, std::size_t row, const std::string& message)
      : std::runtime_error(message), code_(code), row_(row) {}
  int code() const noexcept { return code_; }
  std::size_t row() const noexcept { return row_; }

 private:
  int code_;
  std::size_t row_;
};

/// "rows: row 17: r2 = -1: a semi-axis must be finite and > 0"
[[noreturn]] void refuse_row(std::string_view argument, std::size_t row, std::string_view field,
                             double value, std::string_view rule);
/// "horizon = -1: must be finite and >= 0"
[[noreturn]] void refuse_value(std::string_view argument, double value, std::string_view rule);
/// "answers: must not be NULL"
[[noreturn]] void refuse(std::string_view argument, std::string_view rule);

/// What the current exception says, kept for tangency_error_message().
int kept_failure() noexcept;

/// Nothing is thrown across the border.
template <class Work>
int guarded(const Work& work) noexcept {
  try {
    work();
    return TANGENCY_OK;
  } catch (...) {
    return kept_failure();
  }
}

}  // namespace tangency::inline v0::c
