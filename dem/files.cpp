// SPDX-License-Identifier: MIT
#include <fstream>
#include <sstream>
#include <tangency/dem/files.hpp>

namespace tangency::dem {

std::optional<std::string> read_whole(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream bytes;
  // An empty file sets the failbit of `bytes`, which is no failure to read.
  bytes << in.rdbuf();
  return in.bad() ? std::nullopt : std::optional(bytes.str());
}

void write_whole(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::path part = file;
  part += ".part";
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(part, file, error);
  if (out && !error) return;
  std::filesystem::remove(part, error);
  throw WriteError(file);
}

}  // namespace tangency::dem
