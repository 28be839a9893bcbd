// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The arrays of a .vtp file: XML whose arrays follow as raw bytes in blocks compressed by zlib.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace tangency::testing {

/// The text between two others, of which the first must be there.
inline std::string text_between(const std::string& text, const std::string& before,
                                const std::string& after) {
  const std::size_t at = text.find(before);
  EXPECT_NE(at, text.npos) << before;
  if (at == text.npos) return "";
  const std::size_t start = at + before.size();
  return text.substr(start, text.find(after, start) - start);
}

/// The bytes of an array that begins there: number of blocks, their size, that of a last one that
/// is not full, compressed sizes, blocks.
inline std::string inflated(const std::string& file, std::size_t at) {
  const auto count_at = [&](std::size_t k) {
    std::uint64_t count = 0;
    std::memcpy(&count, file.data() + at + 8 * k, sizeof count);
    return count;
  };
  const std::uint64_t blocks = count_at(0), size = count_at(1), last = count_at(2);
  std::size_t from = at + 8 * (3 + blocks);
  std::string bytes;
  for (std::uint64_t k = 0; k < blocks; ++k) {
    std::string block(k + 1 == blocks && last > 0 ? last : size, '\0');
    uLongf length = block.size();
    EXPECT_EQ(::uncompress(reinterpret_cast<Bytef*>(block.data()), &length,
                           reinterpret_cast<const Bytef*>(file.data() + from), count_at(3 + k)),
              Z_OK);
    EXPECT_EQ(length, block.size());
    bytes += block;
    from += count_at(3 + k);
  }
  return bytes;
}

template <class Number>
void append_numbers(const std::string& bytes, std::vector<double>& numbers) {
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Number)) {
    Number x{};
    std::memcpy(&x, bytes.data() + at, sizeof x);
    numbers.push_back(static_cast<double>(x));
  }
}

/// All arrays by "Element/Name", as PointData/axes.
inline std::map<std::string, std::vector<double>> arrays_of_vtp(const std::string& file) {
  const std::size_t data = file.find("encoding=\"raw\">\n_") + 17;
  std::map<std::string, std::vector<double>> arrays;
  for (const char* element : {"FieldData", "PointData", "CellData", "Points", "Verts", "Lines"}) {
    const std::size_t start = file.find(std::string("<") + element);
    const std::size_t end = file.find(std::string("</") + element);
    if (start == file.npos) continue;
    for (std::size_t at = file.find("<DataArray", start); at < end;
         at = file.find("<DataArray", at + 1)) {
      const std::string tag = file.substr(at, file.find("/>", at) - at);
      const std::string type = text_between(tag, "type=\"", "\"");
      const std::string bytes =
          inflated(file, data + std::stoul(text_between(tag, "offset=\"", "\"")));
      std::vector<double>& numbers =
          arrays[std::string(element) + "/" + text_between(tag, "Name=\"", "\"")];
      if (type == "Float64") append_numbers<double>(bytes, numbers);
      if (type == "Float32") append_numbers<float>(bytes, numbers);
      if (type == "Int32") append_numbers<std::int32_t>(bytes, numbers);
    }
  }
  return arrays;
}

}  // namespace tangency::testing
