// SPDX-License-Identifier: MIT
#include <tangency/geometry/tables/csv.hpp>

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

#include <tangency/geometry/tables/csv_cells.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::tables {
namespace {

// Chosen: large enough that a read costs nothing beside its parsing, small enough for a cache.
constexpr std::size_t kBlockBytes = std::size_t{1} << 18;

// Chosen: a number written in full has at most 24 characters; more is cut short in messages.
constexpr std::size_t kLongestQuotedValue = 60;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Refuses a header that separates its columns by another mark than a comma, and names the mark.
void require_commas(const std::string& file, std::size_t line, std::string_view header) {
  std::size_t commas = 0, semicolons = 0, tabs = 0;
  bool inside = false;
  for (const char c : trimmed(header)) {
    if (c == '"') inside = !inside;
    if (inside) continue;
    commas += c == ',';
    semicolons += c == ';';
    tabs += c == '\t';
  }
  if (commas > 0 || semicolons + tabs == 0) return;
  const std::string mark = semicolons > 0 ? "semicolons" : "tabs";
  throw Error({.file = file,
               .line = line,
               .rule = "the columns are separated by " + mark +
                       "; they must be by commas, and numbers have a decimal point"});
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
  require_commas(file_, line_, text);
  std::string_view rest = text;
  for (bool is_last = false; !is_last;) {
    const std::size_t before = text.size() - rest.size();
    const Cell cell = take_cell(rest);
    const std::string name = cell.has_doubles ? without_doubles(cell.text) : std::string(cell.text);
    const char* rule = cell.rule;
    // A column without a name is an unknown column: some programs write their row labels so.
    if (!rule && !name.empty() && find(name)) rule = "a column must be named only once";
    if (rule) {
      const std::size_t place = line_ + line_breaks(text.substr(0, before));
      throw Error({.file = file_, .line = place, .column = name, .rule = rule});
    }
    names_.push_back(name);
    is_last = cell.is_last;
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
  skip_byte_order_mark();
  read_header();
}

Reader::Reader(const NamedText& table)
    : name_(table.name), text_(table.text), total_bytes_(table.text.size()) {
  skip_byte_order_mark();
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
  if (text_) {
    const std::size_t got = text_->copy(to, size);
    text_->remove_prefix(got);
    return got;
  }
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

/// Before rows are told apart: a quote may follow.
void Reader::skip_byte_order_mark() {
  const auto is_its_start = [&] {
    return kByteOrderMark.starts_with(std::string_view(carry_.data(), carry_.size()));
  };
  std::array<char, kByteOrderMark.size()> some;
  while (carry_.size() < kByteOrderMark.size() && is_its_start()) {
    const std::size_t got = read_some(some.data(), kByteOrderMark.size() - carry_.size());
    if (got == 0) return;
    carry_.insert(carry_.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(got));
  }
  if (!is_its_start()) return;
  carry_.clear();
  offset_ = kByteOrderMark.size();
}

bool Reader::fill(Block& block) {
  std::vector<char>& storage = block.storage;
  std::size_t filled = carry_.size();
  if (storage.size() < filled + kBlockBytes) storage.resize(filled + kBlockBytes);
  std::copy(carry_.begin(), carry_.end(), storage.begin());
  block.has_quotes = false;
  RowEnds ends;
  std::size_t told = 0;  // characters that `ends` has seen: none before the first quote
  std::size_t whole = 0;
  const auto find_whole_rows = [&](std::size_t from) {
    const std::string_view added(&storage[from], filled - from);
    block.has_quotes = block.has_quotes || has_quotes(added);
    if (!block.has_quotes) {
      const std::size_t end = added.rfind('\n');
      if (end != std::string_view::npos) whole = from + end + 1;
      return;
    }
    for (; told < filled; ++told) {
      if (ends.ends_with(storage[told])) whole = told + 1;
    }
  };
  find_whole_rows(0);
  while (whole == 0) {
    if (filled >= kLongestLine) fail_too_long({storage.data(), filled});
    if (storage.size() < filled + kBlockBytes) storage.resize(filled + kBlockBytes);
    const std::size_t got = read_some(&storage[filled], kBlockBytes);
    filled += got;
    find_whole_rows(filled - got);
    if (got == 0) break;
  }
  if (whole == 0) whole = filled;  // the end of the file: its last row may lack a line end
  carry_.assign(storage.begin() + static_cast<std::ptrdiff_t>(whole),
                storage.begin() + static_cast<std::ptrdiff_t>(filled));
  block.size = whole;
  offset_ += whole;
  block.end_offset = offset_;
  return whole > 0 && !cancelled_;
}

void Reader::fail_too_long(std::string_view row) const {
  const bool is_open = row.find('\n') != std::string_view::npos;  // in quotes: else it had ended
  fail(std::string(is_open ? "a quote that is opened must be closed, and a row" : "a line") +
           " must be shorter than " + std::to_string(kLongestLine) + " bytes",
       next_line_);
}

bool Reader::read(Block& block) {
  if (!fill(block)) return false;
  block.first_line = next_line_;
  block.first_row = next_row_;
  for (std::string_view rest = block.text(); !rest.empty(); ++next_line_) {
    const std::string_view row = take_row(rest, block.has_quotes);
    if (is_data(row)) ++next_row_;
    if (block.has_quotes) next_line_ += line_breaks(row);
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
    for (; !header_ && !rest.empty(); ++next_line_) {
      const std::string_view row = take_row(rest, block.has_quotes);
      if (is_data(row)) header_.emplace(name_, next_line_, row);
      next_line_ += line_breaks(row);
    }
    offset_ -= rest.size();
    carry_.insert(carry_.begin(), rest.begin(), rest.end());
  }
  if (!header_) fail("a header line that names the columns is missing");
}

RowCursor::RowCursor(const Header& header) : header_(&header), cells_(header.size()) {}

void RowCursor::enter(const Block& block) noexcept {
  rest_ = block.text();
  block_has_quotes_ = block.has_quotes;
  next_line_ = block.first_line;
  next_index_ = block.first_row;
}

bool RowCursor::next() {
  std::string_view row;
  do {
    if (rest_.empty()) return false;
    row = take_row(rest_, block_has_quotes_);
    line_ = next_line_++;
    if (block_has_quotes_) next_line_ += line_breaks(row);
  } while (!is_data(row));
  index_ = next_index_++;
  is_quoted_ = block_has_quotes_ && has_quotes(row);
  if (is_quoted_) {
    split_quoted(row);
  } else {
    split(row);
  }
  return true;
}

void RowCursor::split(std::string_view row) {
  const std::string_view whole = row;
  for (std::size_t i = 0; i + 1 < cells_.size(); ++i) cells_[i] = take_until(row, ',');
  cells_.back() = row;
  // Short rows have run empty before the last cell, long ones have a comma left in it; counting
  // the commas of every row would cost a second pass.
  const bool short_row = cells_.size() > 1 && cells_[cells_.size() - 2].end() == whole.end();
  if (!short_row && row.find(',') == std::string_view::npos) return;
  fail_length(static_cast<std::size_t>(std::count(whole.begin(), whole.end(), ',')) + 1);
}

void RowCursor::split_quoted(std::string_view row) {
  breaks_.assign(cells_.size(), 0);
  unquoted_.clear();
  unquoted_.reserve(row.size());  // so that it never moves
  const std::string_view whole = row;
  std::size_t count = 0;
  for (bool is_last = false; !is_last; ++count) {
    const std::size_t breaks = line_breaks(whole.substr(0, whole.size() - row.size()));
    Cell cell = take_cell(row);
    is_last = cell.is_last;
    if (cell.rule) {
      throw Error({.file = header_->file(),
                   .line = line_ + breaks,
                   .column = count < cells_.size() ? header_->name(Column{count}) : "",
                   .value = std::string(cell.text),
                   .rule = cell.rule});
    }
    if (count >= cells_.size()) continue;
    if (cell.has_doubles) {
      const std::size_t begin = unquoted_.size();
      unquoted_ += without_doubles(cell.text);
      cell.text = std::string_view(unquoted_).substr(begin);
    }
    cells_[count] = cell.text;
    breaks_[count] = breaks;
  }
  if (count != cells_.size()) fail_length(count);
}

void RowCursor::fail_length(std::size_t count) const {
  throw Error({.file = header_->file(),
               .line = line_,
               .value = std::to_string(count) + (count == 1 ? " cell" : " cells"),
               .rule = "a row must have as many cells as the header has columns, " +
                       std::to_string(cells_.size())});
}

std::string_view RowCursor::text(Column column) const noexcept {
  const std::string_view cell = cells_[static_cast<std::size_t>(column)];
  return is_quoted_ ? cell : trimmed(cell);
}

double RowCursor::number(Column column) const {
  double value = 0;
  if (const auto rule = parse_number(text(column), value)) throw error(column, *rule);
  return value;
}

Error RowCursor::error(Column column, std::string_view rule) const {
  const std::string_view value = text(column);
  const std::size_t breaks = is_quoted_ ? breaks_[static_cast<std::size_t>(column)] : 0;
  return Error({.file = header_->file(),
                .line = line_ + breaks,
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
  separate();
  append_text(buffer_, value);
}

void RowText::integer(std::uint64_t value) {
  separate();
  append_text(buffer_, value);
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

}  // namespace tangency::inline v0::tables
