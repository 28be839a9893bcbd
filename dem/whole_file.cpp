// SPDX-License-Identifier: MIT
#include <tangency/dem/whole_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <new>
#include <system_error>
#include <utility>

#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::dem {
namespace {

std::filesystem::path part_of(std::filesystem::path file) { return file += ".part"; }

}  // namespace

FileError::FileError(const std::filesystem::path& file, const char* done, int problem)
    : std::runtime_error(file.string() + ": cannot be " + done + ": " +
                         std::generic_category().message(problem)),
      problem_(problem) {}

std::string bytes_of_file(const std::filesystem::path& file) {
  const tables::Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
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

WholeFile::WholeFile(std::filesystem::path file)
    : file_(std::move(file)),
      part_(part_of(file_)),
      out_(::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (out_ >= 0) return;
  const int problem = errno;
  std::error_code error;
  std::filesystem::remove(part_, error);
  throw WriteError(file_, problem);
}

WholeFile::~WholeFile() {
  if (out_ < 0) return;
  ::close(out_);
  std::error_code error;
  std::filesystem::remove(part_, error);
}

void WholeFile::write(std::string_view bytes) { write_all(out_, bytes, file_); }

void WholeFile::publish() {
  const bool closed = ::close(std::exchange(out_, -1)) == 0;
  if (closed && ::rename(part_.c_str(), file_.c_str()) == 0) return;
  const int problem = errno;
  std::error_code error;
  std::filesystem::remove(part_, error);
  throw WriteError(file_, problem);
}

void write_whole(const std::filesystem::path& file, std::string_view bytes) {
  WholeFile out(file);
  out.write(bytes);
  out.publish();
}

bool link_whole(const std::filesystem::path& file, const std::filesystem::path& to) noexcept {
  try {
    const std::filesystem::path part = part_of(to);
    if (::link(file.c_str(), part.c_str()) != 0) return false;
    const bool renamed = ::rename(part.c_str(), to.c_str()) == 0;
    // Where `to` was a name of the file already, renaming does nothing.
    ::unlink(part.c_str());
    return renamed;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

}  // namespace tangency::inline v0::dem
