// SPDX-License-Identifier: MIT
/// @file
/// The layout of GSD files: what stands at which byte. Internal to gsd_write.cpp and gsd_read.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <tangency/dem/saved/little_endian.hpp>

namespace tangency::inline v0::dem::gsd {

inline constexpr std::uint64_t kMagic = 0x65DF65DF65DF65DF;
/// 0xaaaabbbb is version aaaa.bbbb: the file layer's 2.0, the schema's 1.4.
inline constexpr std::uint32_t kVersion = 0x00020000, kSchemaVersion = 0x00010004;
inline constexpr const char* kSchema = "hoomd";
/// Bytes in which the length of the list of names is counted.
inline constexpr std::size_t kNameUnit = 64;

struct Header {
  std::uint64_t magic, index_location, index_entries, names_location, names_units;
  std::uint32_t schema_version, version;
  char application[64], schema[64], reserved[80];
};
static_assert(sizeof(Header) == 256);

/// Sorted by frame, then id; one with location 0 ends the index.
struct IndexEntry {
  std::uint64_t frame, rows;
  std::int64_t location;
  std::uint32_t columns;
  std::uint16_t id;  ///< place of the name in the list
  std::uint8_t type, flags;
};
static_assert(sizeof(IndexEntry) == 32);

/// From what stands in a file, or the same way back into it.
inline void turn(Header& header) {
  for (auto* x : {&header.magic, &header.index_location, &header.index_entries,
                  &header.names_location, &header.names_units})
    from_little_endian(x, 1);
  for (auto* x : {&header.schema_version, &header.version}) from_little_endian(x, 1);
}
inline void turn(IndexEntry& entry) {
  for (auto* x : {&entry.frame, &entry.rows}) from_little_endian(x, 1);
  from_little_endian(&entry.location, 1);
  from_little_endian(&entry.columns, 1);
  from_little_endian(&entry.id, 1);
}

template <class Number>
constexpr std::uint8_t type_of() {
  if constexpr (std::is_same_v<Number, std::uint8_t>) return 1;
  if constexpr (std::is_same_v<Number, std::uint32_t>) return 3;
  if constexpr (std::is_same_v<Number, std::uint64_t>) return 4;
  if constexpr (std::is_same_v<Number, std::int8_t>) return 5;
  if constexpr (std::is_same_v<Number, std::int32_t>) return 7;
  if constexpr (std::is_same_v<Number, float>) return 9;
}

}  // namespace tangency::inline v0::dem::gsd
