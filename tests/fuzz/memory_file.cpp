// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/fuzz/memory_file.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>

// Of the sanitizers' library, where the program has it.
extern "C" __attribute__((weak)) void __sanitizer_set_report_fd(void* file);  // NOLINT

namespace tangency::testing::fuzz {
namespace {

void require_done(bool done, const char* what) { require(done, "memory file", what); }

void empty(int file) {
  require_done(::ftruncate(file, 0) == 0 && ::lseek(file, 0, SEEK_SET) == 0, "cannot be emptied");
}

}  // namespace

MemoryFile::MemoryFile()
    : file_(::memfd_create("fuzz", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(file_)) {
  require_done(file_ >= 0, "cannot be made");
}

MemoryFile::~MemoryFile() { ::close(file_); }

void MemoryFile::set(Bytes bytes) {
  empty(file_);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t more = ::write(file_, bytes.data() + done, bytes.size() - done);
    require_done(more > 0, "cannot be written");
    done += static_cast<std::size_t>(more);
  }
}

std::string MemoryFile::text() const {
  struct stat status {};
  require_done(::fstat(file_, &status) == 0, "cannot be looked at");
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  require_done(::pread(file_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()),
               "cannot be read");
  return text;
}

Diverted::Diverted(int output, MemoryFile& to) : output_(output), kept_(::dup(output)) {
  std::fflush(nullptr);
  empty(to.descriptor());
  require_done(kept_ >= 0 && ::dup2(to.descriptor(), output_) == output_, "takes no output");
  if (output_ == 2 && __sanitizer_set_report_fd != nullptr)
    __sanitizer_set_report_fd(reinterpret_cast<void*>(static_cast<std::ptrdiff_t>(kept_)));
}

Diverted::~Diverted() {
  std::fflush(nullptr);
  ::dup2(kept_, output_);
  ::close(kept_);
  if (output_ == 2 && __sanitizer_set_report_fd != nullptr)
    __sanitizer_set_report_fd(reinterpret_cast<void*>(std::ptrdiff_t{2}));
}

}  // namespace tangency::testing::fuzz
