// SPDX-License-Identifier: MIT
#include <tangency/dem/whole_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>

#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::dem {
namespace {

tables::Descriptor opened(const std::filesystem::path& file, int how) noexcept {
  return tables::Descriptor(::open(file.c_str(), how | O_CLOEXEC, 0666));
}

}  // namespace

FileError::FileError(const std::filesystem::path& file, const char* done, int problem)
    : std::runtime_error(file.string() + ": cannot be " + done + ": " +
                         std::generic_category().message(problem)),
      problem_(problem) {}

std::string bytes_of_file(const std::filesystem::path& file) {
  const tables::Descriptor in = opened(file, O_RDONLY);
  if (!in.is_open()) throw ReadError(file, errno);
  std::string bytes;
  std::array<char, 1 << 16> some;
  for (;;) {
    const ssize_t got = ::read(in.get(), some.data(), some.size());
    if (got == 0) return bytes;
    if (got < 0 && errno != EINTR) throw ReadError(file, errno);
    if (got > 0) bytes.append(some.data(), static_cast<std::size_t>(got));
  }
}

std::optional<std::string> read_whole(const std::filesystem::path& file) {
  try {
    return bytes_of_file(file);
  } catch (const ReadError&) {
    return std::nullopt;
  }
}

void write_all(int file, std::string_view bytes, const std::filesystem::path& name) {
  if (!tables::write_all(file, bytes)) throw WriteError(name, errno);
}

void write_whole(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path part = file;
  part += ".part";
  try {
    tables::Descriptor out = opened(part, O_WRONLY | O_CREAT | O_TRUNC);
    if (!out.is_open()) throw WriteError(file, errno);
    write_all(out.get(), bytes, file);
    if (!out.close() || ::rename(part.c_str(), file.c_str()) != 0) throw WriteError(file, errno);
  } catch (const WriteError&) {
    std::error_code error;
    std::filesystem::remove(part, error);
    throw;
  }
}

}  // namespace tangency::dem
