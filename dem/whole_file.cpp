// SPDX-License-Identifier: MIT
#include <tangency/dem/whole_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

namespace tangency::dem {
namespace {

/// Closed at the latest with its scope.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& file, int how) noexcept
      : file_(::open(file.c_str(), how | O_CLOEXEC, 0666)) {}
  ~OpenFile() { close(); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const noexcept { return file_ >= 0; }
  int get() const noexcept { return file_; }
  /// False where the last bytes could not be stored.
  bool close() noexcept { return file_ < 0 || ::close(std::exchange(file_, -1)) == 0; }

 private:
  int file_;
};

}  // namespace

FileError::FileError(const std::filesystem::path& file, const char* done, int problem)
    : std::runtime_error(file.string() + ": cannot be " + done + ": " +
                         std::generic_category().message(problem)),
      problem_(problem) {}

std::string bytes_of_file(const std::filesystem::path& file) {
  const OpenFile in(file, O_RDONLY);
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
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) throw WriteError(name, errno);
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void write_whole(const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::path part = file;
  part += ".part";
  try {
    OpenFile out(part, O_WRONLY | O_CREAT | O_TRUNC);
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
