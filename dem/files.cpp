// SPDX-License-Identifier: MIT
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <tangency/dem/files.hpp>

namespace tangency::dem {

WriteError::WriteError(const std::filesystem::path& file, int problem)
    : std::runtime_error(file.string() + ": cannot be written" +
                         (problem == 0 ? "" : ": " + std::generic_category().message(problem))) {}

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
  errno = 0;
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  const int problem = errno;  // of the first call of the system that failed: none follows it
  std::error_code error;
  if (out) std::filesystem::rename(part, file, error);
  if (out && !error) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw WriteError(file, out ? error.value() : problem);
}

}  // namespace tangency::dem
