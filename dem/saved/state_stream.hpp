// SPDX-License-Identifier: MIT
/// @file
/// Bytes of a state on their way to a file or from one, hashed as they pass: what state_file.cpp is
/// made of. A block of memory goes through in slices that stay in a cache, small numbers through a
/// buffer; nothing is held twice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <type_traits>
#include <vector>

#include <tangency/dem/saved/little_endian.hpp>
#include <tangency/dem/saved/stream_hash.hpp>
#include <tangency/dem/whole_file.hpp>
#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::dem {

/// Bytes that are no state.
struct Damaged {
  const char* why;
};
inline constexpr Damaged kNotWhole{"it is not a whole state"};

class StateWriter {
 public:
  /// @param file  null: the bytes are only hashed
  explicit StateWriter(WholeFile* file);

  /// @throws WriteError  as all that writes
  template <Number T>
  void operator()(const T& value) {
    const auto bytes = little_endian_bytes(value);
    small(bytes.data(), bytes.size());
  }
  template <Number T>
  void block(const T* numbers, std::size_t count) {
    if constexpr (kIsLittleEndian)
      raw(numbers, count * sizeof(T));
    else
      for (std::size_t k = 0; k < count; ++k) (*this)(numbers[k]);
  }
  /// The hash of all that was passed, and sends it all on its way.
  std::uint64_t finish();

 private:
  void raw(const void* bytes, std::size_t size);
  void small(const void* bytes, std::size_t size);
  void send();
  void slice(const char* bytes, std::size_t size);

  WholeFile* file_;
  StreamHash hash_;
  std::vector<char> waiting_;
};

class StateReader {
 public:
  /// Of a file, or a pipe until it is closed.
  /// @throws ReadError  as all that reads
  explicit StateReader(const std::filesystem::path& file);

  /// At most `size` bytes from the start, which are not hashed. Returns how many there were.
  std::size_t head(char* bytes, std::size_t size);

  /// @throws Damaged  where the bytes end, or hold a double that is not finite
  template <Number T>
  void operator()(T& value) {
    raw(&value, sizeof value);
    from_little_endian(&value, 1);
    if constexpr (std::is_floating_point_v<T>) require_finite(&value, 1);
  }
  void block(double* numbers, std::size_t count) {
    raw(numbers, count * sizeof(double));
    from_little_endian(numbers, count);
    require_finite(numbers, count);
  }
  void block(std::int32_t* numbers, std::size_t count) {
    raw(numbers, count * sizeof(std::int32_t));
    from_little_endian(numbers, count);
  }
  /// No more bytes than these are left; of a pipe that is not known.
  std::uint64_t most_left() const { return most_left_; }
  bool is_pipe() const { return is_pipe_; }

  /// What was found behind what was read.
  struct Ending {
    bool hash_is_right;  ///< the last eight bytes are the hash of all before them
    bool is_at_once;     ///< and these were all
  };
  Ending finish();

 private:
  void raw(void* bytes, std::size_t size);
  static void require_finite(const double* numbers, std::size_t count);
  std::size_t read_some(char* to, std::size_t most);
  void hash_what_was_taken();
  bool refill();

  std::filesystem::path name_;
  tables::Descriptor file_;
  bool is_pipe_ = false;
  std::uint64_t most_left_ = 0;
  StreamHash hash_;
  std::vector<char> buffer_;
  std::size_t hashed_ = 0, taken_ = 0, end_ = 0;  ///< places in the buffer, in this order
};

}  // namespace tangency::inline v0::dem
