// SPDX-License-Identifier: MIT
#include <tangency/dem/saved/state_stream.hpp>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <limits>
#include <string_view>

namespace tangency::inline v0::dem {
namespace {

/// Bytes. Chosen: it stays in a core's own cache between hashing and writing, and a call of the
/// system a slice costs nothing beside its bytes.
constexpr std::size_t kSlice = std::size_t{1} << 18;

constexpr std::size_t kHash = sizeof(std::uint64_t);

}  // namespace

StateWriter::StateWriter(WholeFile* file) : file_(file) { waiting_.reserve(kSlice); }

void StateWriter::slice(const char* bytes, std::size_t size) {
  hash_.add(bytes, size);
  if (file_ != nullptr) file_->write(std::string_view(bytes, size));
}

void StateWriter::send() {
  slice(waiting_.data(), waiting_.size());
  waiting_.clear();
}

void StateWriter::small(const void* bytes, std::size_t size) {
  if (waiting_.size() + size > kSlice) send();
  const char* first = static_cast<const char*>(bytes);
  waiting_.insert(waiting_.end(), first, first + size);
}

void StateWriter::raw(const void* bytes, std::size_t size) {
  if (size <= kSlice / 2) return small(bytes, size);
  send();
  const char* at = static_cast<const char*>(bytes);
  for (std::size_t left = size; left > 0;) {
    const std::size_t some = std::min(left, kSlice);
    slice(at, some);
    at += some;
    left -= some;
  }
}

std::uint64_t StateWriter::finish() {
  send();
  return hash_.value();
}

StateReader::StateReader(const std::filesystem::path& file)
    : name_(file), file_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)), buffer_(kSlice) {
  if (!file_.is_open()) throw ReadError(file, errno);
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) throw ReadError(file, errno);
  is_pipe_ = !S_ISREG(status.st_mode);
  most_left_ = is_pipe_ ? std::numeric_limits<std::uint64_t>::max()
                        : static_cast<std::uint64_t>(status.st_size);
}

/// 0: at the end.
std::size_t StateReader::read_some(char* to, std::size_t most) {
  for (;;) {
    const ssize_t got = ::read(file_.get(), to, most);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR) throw ReadError(name_, errno);
  }
}

void StateReader::hash_what_was_taken() {
  hash_.add(buffer_.data() + hashed_, taken_ - hashed_);
  hashed_ = taken_;
}

/// Makes room and reads more. False at the end.
bool StateReader::refill() {
  hash_what_was_taken();
  std::copy(buffer_.data() + taken_, buffer_.data() + end_, buffer_.data());
  end_ -= taken_;
  hashed_ = taken_ = 0;
  const std::size_t got = read_some(buffer_.data() + end_, kSlice - end_);
  end_ += got;
  return got > 0;
}

std::size_t StateReader::head(char* bytes, std::size_t size) {
  while (end_ < size && refill()) {
  }
  const std::size_t count = std::min(size, end_);
  std::copy_n(buffer_.data(), count, bytes);
  hashed_ = taken_ = count;
  most_left_ -= std::min<std::uint64_t>(most_left_, count);
  return count;
}

void StateReader::raw(void* bytes, std::size_t size) {
  char* to = static_cast<char*>(bytes);
  most_left_ -= std::min<std::uint64_t>(most_left_, size);
  for (;;) {
    const std::size_t some = std::min(size, end_ - taken_);
    std::copy_n(buffer_.data() + taken_, some, to);
    taken_ += some;
    to += some;
    size -= some;
    if (size == 0) return;
    if (size < kSlice) {
      if (!refill()) throw kNotWhole;
      continue;
    }
    hash_what_was_taken();  // and the buffer is empty
    while (size >= kSlice) {
      const std::size_t got = read_some(to, kSlice);
      if (got == 0) throw kNotWhole;
      hash_.add(to, got);
      to += got;
      size -= got;
    }
  }
}

void StateReader::require_finite(const double* numbers, std::size_t count) {
  if (!std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); }))
    throw Damaged{"it holds a number that is not finite"};
}

StateReader::Ending StateReader::finish() {
  bool is_at_once = end_ - taken_ <= kHash;
  while (refill()) {
    if (end_ - taken_ <= kHash) continue;
    is_at_once = false;
    taken_ = end_ - kHash;
  }
  if (end_ - taken_ != kHash) {
    is_at_once = false;
    if (end_ - taken_ < kHash) return {false, false};
    taken_ = end_ - kHash;
  }
  hash_what_was_taken();
  std::array<char, kHash> bytes;
  std::copy_n(buffer_.data() + taken_, kHash, bytes.begin());
  return {of_little_endian_bytes<std::uint64_t>(bytes) == hash_.value(), is_at_once};
}

}  // namespace tangency::inline v0::dem
