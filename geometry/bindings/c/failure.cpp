// SPDX-License-Identifier: MIT
#include <tangency/geometry/bindings/c/failure.hpp>

#include <array>
#include <cstdio>
#include <exception>
#include <new>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::c {
namespace {

/// Of a thread. Without allocation, so that the end of memory can be told too; longer messages are
/// cut short. Chosen: ten times what the longest takes.
struct Failure {
  std::array<char, 1024> message{};
  std::size_t row = kNoRow;
};

Failure& last_failure() noexcept {
  thread_local Failure failure;
  return failure;
}

int keep(int code, std::size_t row, const char* message) noexcept {
  Failure& failure = last_failure();
  std::snprintf(failure.message.data(), failure.message.size(), "%s", message);
  failure.row = row;
  return code;
}

std::string value_and_rule(std::string_view field, double value, std::string_view rule) {
  std::string text(field);
  text += " = ";
  tables::append_text(text, value);
  text += ": ";
  return text.append(rule);
}

}  // namespace

void refuse_row(std::string_view argument, std::size_t row, std::string_view field, double value,
                std::string_view rule) {
  std::string text(argument);
  text += ": row ";
  tables::append_text(text, row);
  throw Refused(TANGENCY_BAD_ROW, row, text + ": " + value_and_rule(field, value, rule));
}

void refuse_value(std::string_view argument, double value, std::string_view rule) {
  throw Refused(TANGENCY_BAD_ARGUMENT, kNoRow, value_and_rule(argument, value, rule));
}

void refuse(std::string_view argument, std::string_view rule) {
  throw Refused(TANGENCY_BAD_ARGUMENT, kNoRow, std::string(argument) + ": " + std::string(rule));
}

int kept_failure() noexcept {
  try {
    throw;
  } catch (const Refused& refused) {
    return keep(refused.code(), refused.row(), refused.what());
  } catch (const std::bad_alloc&) {
    return keep(TANGENCY_OUT_OF_MEMORY, kNoRow, "there is not enough memory");
  } catch (const std::length_error&) {
    return keep(TANGENCY_OUT_OF_MEMORY, kNoRow, "there is not enough memory");
  } catch (const std::invalid_argument& refused) {
    return keep(TANGENCY_BAD_ARGUMENT, kNoRow, refused.what());
  } catch (const std::exception& unknown) {
    return keep(TANGENCY_INTERNAL, kNoRow, unknown.what());
  } catch (...) {
    return keep(TANGENCY_INTERNAL, kNoRow, "an exception without a text");
  }
}

}  // namespace tangency::inline v0::c

extern "C" {

const char* tangency_error_message(void) { return tangency::c::last_failure().message.data(); }

size_t tangency_error_row(void) { return tangency::c::last_failure().row; }

}  // extern "C"
