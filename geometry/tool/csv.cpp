// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/csv.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace tangency::csv {
namespace {

// Chosen: large enough that a read costs nothing beside its parsing, small enough for a cache.
constexpr std::size_t kBlockBytes = std::size_t{1} << 18;

// Chosen: a number written in full has at most 24 characters; more is cut short in messages.
constexpr std::size_t kLongestQuotedValue = 60;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_space(char c) noexcept { return c <= ' ' && (c == ' ' || c == '\t' || c == '\r'); }

std::string_view trimmed(std::string_view text) noexcept {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

/// Cuts the text at the first mark: returns what is before it and leaves what is after it.
std::string_view take_until(std::string_view& text, char mark) noexcept {
  const std::size_t end = text.find(mark);
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return taken;
}

bool is_data(std::string_view line) noexcept {
  for (const char c : line) {
    if (!is_space(c)) return c != '#';
  }
  return false;
}

std::string printable(std::string_view text) {
  std::string shown(text.substr(0, kLongestQuotedValue));
  for (char& c : shown) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) c = '?';
  }
  if (text.size() > kLongestQuotedValue) shown += "...";
  return shown;
}

std::string message(const Fault& fault) {
  std::string text = fault.file;
  if (fault.line > 0) text += ':' + std::to_string(fault.line);
  text += ": ";
  if (!fault.column.empty()) text += printable(fault.column);
  if (!fault.column.empty() && !fault.value.empty()) text += " = ";
  if (!fault.value.empty()) text += printable(fault.value);
  if (!fault.column.empty() || !fault.value.empty()) text += ": ";
  return text + fault.rule;
}

}  // namespace

Error::Error(Fault fault) : std::runtime_error(message(fault)), fault_(std::move(fault)) {}

std::optional<std::string_view> parse_number(std::string_view cell, double& value) noexcept {
  constexpr std::string_view kNotANumber =
      "a cell must hold a number, in decimal or as a hex float";
  std::string_view digits = cell;
  const bool negative = !digits.empty() && digits.front() == '-';
  if (negative || (!digits.empty() && digits.front() == '+')) digits.remove_prefix(1);
  auto format = std::chars_format::general;
  if (digits.size() > 1 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X')) {
    format = std::chars_format::hex;
    digits.remove_prefix(2);
  }
  // from_chars would take a second sign here.
  if (digits.empty() || digits.front() == '-') return kNotANumber;
  double magnitude = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, magnitude, format);
  if (problem == std::errc::invalid_argument || stop != end) return kNotANumber;
  if (problem == std::errc::result_out_of_range) {
    return "a number must be 0 or between 4.9e-324 and 1.8e308 in size, the range of a double";
  }
  if (!std::isfinite(magnitude)) return "a number must be finite";
  value = negative ? -magnitude : magnitude;
  return std::nullopt;
}

Header::Header(std::string file, std::size_t line, std::string_view text)
    : file_(std::move(file)), line_(line) {
  const auto columns = static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')) + 1;
  names_.reserve(columns);
  for (std::size_t i = 0; i < columns; ++i) {
    const std::string_view name = trimmed(take_until(text, ','));
    if (name.find('"') != std::string_view::npos) {
      throw Error({.file = file_,
                   .line = line_,
                   .value = std::string(name),
                   .rule = "names and numbers are written without quotes"});
    }
    // A column without a name is an unknown column: some programs write their row labels so.
    if (!name.empty() && find(name)) {
      throw Error({.file = file_,
                   .line = line_,
                   .column = std::string(name),
                   .rule = "a column must be named only once"});
    }
    names_.emplace_back(name);
  }
}

std::optional<Column> Header::find(std::string_view name) const noexcept {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return std::nullopt;
  return static_cast<Column>(found - names_.begin());
}

Column Header::require(std::string_view name) const {
  if (const auto column = find(name)) return *column;
  throw Error({.file = file_,
               .line = line_,
               .column = std::string(name),
               .rule = "this column is missing"});
}

Reader::Reader(const std::string& path) {
  open(path);
  read_header();
}

void Reader::fail(std::string rule, std::size_t line) const {
  throw Error({.file = name_, .line = line, .rule = std::move(rule)});
}

void Reader::fail_reading(int problem) const {
  fail("cannot be read: " + std::generic_category().message(problem));
}

void Reader::open(const std::string& path) {
  const bool is_file = !path.empty() && path != "-";
  name_ = is_file ? path : std::string(kStandardInputName);
  input_ = Descriptor(is_file ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC) : STDIN_FILENO);
  struct stat status {};
  if (!input_.is_open() || ::fstat(input_.get(), &status) != 0) fail_reading(errno);
  if (S_ISREG(status.st_mode)) {
    total_bytes_ = static_cast<std::uint64_t>(status.st_size);
  } else {
    wake_ = Descriptor(::eventfd(0, EFD_CLOEXEC));
    if (!wake_.is_open()) fail_reading(errno);
  }
}

void Reader::cancel() noexcept {
  cancelled_ = true;
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

std::size_t Reader::read_some(char* to, std::size_t size) {
  while (!cancelled_) {
    if (wake_.is_open()) {
      std::array<pollfd, 2> events{{{input_.get(), POLLIN, 0}, {wake_.get(), POLLIN, 0}}};
      if (::poll(events.data(), events.size(), -1) < 0 && errno != EINTR) fail_reading(errno);
      if (events[0].revents == 0) continue;
    }
    const ssize_t got = ::read(input_.get(), to, size);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno != EINTR && errno != EAGAIN) fail_reading(errno);
  }
  return 0;
}

bool Reader::fill(Block& block) {
  std::vector<char>& storage = block.storage;
  std::size_t filled = carry_.size();
  if (storage.size() < filled + kBlockBytes) storage.resize(filled + kBlockBytes);
  std::copy(carry_.begin(), carry_.end(), storage.begin());
  const auto whole_lines_from = [&](std::size_t from) -> std::size_t {
    const std::size_t end = std::string_view(&storage[from], filled - from).rfind('\n');
    return end == std::string_view::npos ? 0 : from + end + 1;
  };
  std::size_t whole = whole_lines_from(0);
  while (whole == 0) {
    if (filled >= kLongestLine) {
      fail("a line must be shorter than " + std::to_string(kLongestLine) + " bytes", next_line_);
    }
    if (storage.size() < filled + kBlockBytes) storage.resize(filled + kBlockBytes);
    const std::size_t got = read_some(&storage[filled], kBlockBytes);
    filled += got;
    whole = whole_lines_from(filled - got);
    if (got == 0) break;
  }
  if (whole == 0) whole = filled;  // the end of the file: its last line may lack a line end
  carry_.assign(storage.begin() + static_cast<std::ptrdiff_t>(whole),
                storage.begin() + static_cast<std::ptrdiff_t>(filled));
  block.size = whole;
  offset_ += whole;
  block.end_offset = offset_;
  return whole > 0 && !cancelled_;
}

bool Reader::read(Block& block) {
  if (!fill(block)) return false;
  block.first_line = next_line_;
  block.first_row = next_row_;
  for (std::string_view rest = block.text(); !rest.empty(); ++next_line_) {
    if (is_data(take_until(rest, '\n'))) ++next_row_;
  }
  return true;
}

void Reader::read_header() {
  Block block;
  while (!header_ && fill(block)) {
    std::string_view rest = block.text();
    if (rest.starts_with("\xFF\xFE") || rest.starts_with("\xFE\xFF")) {
      fail("the text must be UTF-8; this looks like UTF-16");
    }
    if (next_line_ == 1 && rest.starts_with(kByteOrderMark)) {
      rest.remove_prefix(kByteOrderMark.size());
    }
    for (; !header_ && !rest.empty(); ++next_line_) {
      const std::string_view line = take_until(rest, '\n');
      if (is_data(line)) header_.emplace(name_, next_line_, line);
    }
    offset_ -= rest.size();
    carry_.insert(carry_.begin(), rest.begin(), rest.end());
  }
  if (!header_) fail("a header line that names the columns is missing");
}

RowCursor::RowCursor(const Header& header) : header_(&header), cells_(header.size()) {}

void RowCursor::enter(const Block& block) noexcept {
  rest_ = block.text();
  next_line_ = block.first_line;
  next_index_ = block.first_row;
}

bool RowCursor::next() {
  std::string_view row;
  do {
    if (rest_.empty()) return false;
    row = take_until(rest_, '\n');
    line_ = next_line_++;
  } while (!is_data(row));
  index_ = next_index_++;
  const std::string_view whole = row;
  for (std::size_t i = 0; i + 1 < cells_.size(); ++i) cells_[i] = take_until(row, ',');
  cells_.back() = row;
  // Short rows have run empty before the last cell, long ones have a comma left in it; counting
  // the commas of every row would cost a second pass.
  const bool short_row = cells_.size() > 1 && cells_[cells_.size() - 2].end() == whole.end();
  if (!short_row && row.find(',') == std::string_view::npos) return true;
  const auto count = std::count(whole.begin(), whole.end(), ',') + 1;
  throw Error({.file = header_->file(),
               .line = line_,
               .value = std::to_string(count) + (count == 1 ? " cell" : " cells"),
               .rule = "a row must have as many cells as the header has columns, " +
                       std::to_string(cells_.size())});
}

std::string_view RowCursor::text(Column column) const noexcept {
  return trimmed(cells_[static_cast<std::size_t>(column)]);
}

double RowCursor::number(Column column) const {
  double value = 0;
  if (const auto rule = parse_number(text(column), value)) throw error(column, *rule);
  return value;
}

Error RowCursor::error(Column column, std::string_view rule) const {
  const std::string_view value = text(column);
  return Error({.file = header_->file(),
                .line = line_,
                .column = header_->name(column),
                .value = std::string(value.empty() ? "(empty)" : value),
                .rule = std::string(rule)});
}

void RowText::separate() {
  if (!std::exchange(at_row_start_, false)) buffer_ += ',';
}

void RowText::header(std::span<const std::string_view> names) {
  for (const std::string_view name : names) text(name);
  end_row();
}

void RowText::text(std::string_view cell) {
  assert(cell.find_first_of(",\"\r\n") == std::string_view::npos && !cell.starts_with('#'));
  separate();
  buffer_ += cell;
}

void RowText::cells(std::string_view written) {
  separate();
  buffer_ += written;
}

void RowText::number(double value) {
  assert(std::isfinite(value));
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  separate();
  buffer_.append(digits.data(), end);
}

void RowText::integer(std::uint64_t value) {
  std::array<char, 20> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  separate();
  buffer_.append(digits.data(), end);
}

void RowText::empty(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) separate();
}

void RowText::end_row() {
  buffer_ += '\n';
  at_row_start_ = true;
}

void RowText::truncate(std::size_t size) noexcept {
  buffer_.resize(size);
  at_row_start_ = true;
}

}  // namespace tangency::csv
