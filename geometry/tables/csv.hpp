// SPDX-License-Identifier: MIT
/// @file
/// Comma-separated tables, read and written as a stream in constant memory.
///
/// A table is UTF-8 text (a byte-order mark is tolerated): a header line that names the columns, in
/// any order, then a line a row. Blank lines and lines that begin with `#`, blanks aside, are
/// skipped; spaces and tabs around cells and CRLF line ends are allowed. A row is shorter than
/// `kLongestLine` bytes.
///
/// Quotes are those of RFC 4180: a cell may stand in them whole, and is then what stands between
/// them to the letter: commas, blanks, line breaks, and a quote for every two. So a row may go over
/// several lines; it counts once, and is named by the line where it begins, its cells by the lines
/// where they begin. A quoted cell is never a comment, and a quote anywhere else is refused.
///
/// (1) Numbers are written so that they read back to the same double.
/// (2) A number is read correctly rounded, from decimal or from a hex float.
/// (3) Whatever is refused is refused with one Error that names file, line, column, value and rule.
/// (4) Quoting cells that need none changes nothing.
///
/// Reading is cut in two for threads: Reader::read hands out blocks of whole rows, one caller at a
/// time; a RowCursor a thread then splits and parses the rows of a block. One thread alone uses
/// for_each_row().
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <tangency/geometry/tables/descriptor.hpp>

namespace tangency::inline v0::tables {

/// What standard input is called in messages.
inline constexpr std::string_view kStandardInputName = "<stdin>";

/// The most bytes that a row may have; chosen: a thousand columns fit many times over.
inline constexpr std::size_t kLongestLine = std::size_t{1} << 20;

/// What was refused, where, and what is allowed. Empty and 0 mean "does not apply".
struct Fault {
  std::string file{};
  std::size_t line = 0;  ///< from 1
  std::string column{};
  std::string value{};  ///< as it stands in the file
  std::string rule{};
};

/// Refused input or a failed read or write. what() is one line, `pairs.csv:17: a.r2 = -1: a
/// semi-axis must be finite and > 0`, in which control characters show as `?` and a long value is
/// cut short.
class Error : public std::runtime_error {
 public:
  explicit Error(Fault fault);
  const Fault& fault() const noexcept { return fault_; }

 private:
  Fault fault_;
};

/// Reads a whole cell without spaces around it: [sign] digits with point and exponent, or a hex
/// float such as 0x1.8p+3. Returns nothing on success, else the rule that was broken: empty, not a
/// number, not finite, or beyond the range of double at either end.
std::optional<std::string_view> parse_number(std::string_view cell, double& value) noexcept;

/// A column of a header, by its place in the file.
enum class Column : std::size_t {};

/// The names of the columns of one file.
class Header {
 public:
  /// @param text  the header's row
  /// @throws Error  a column named twice, a stray quote, or columns that no comma separates
  Header(std::string file, std::size_t line, std::string_view text);

  const std::string& file() const noexcept { return file_; }
  std::size_t line() const noexcept { return line_; }
  std::size_t size() const noexcept { return names_.size(); }
  const std::string& name(Column column) const { return names_[static_cast<std::size_t>(column)]; }
  std::optional<Column> find(std::string_view name) const noexcept;
  /// @throws Error  naming the column that is missing
  Column require(std::string_view name) const;

 private:
  std::string file_;
  std::size_t line_;
  std::vector<std::string> names_;
};

/// Whole rows of a file, and where they stand in it. Reused from one read to the next.
struct Block {
  std::vector<char> storage;
  std::size_t size = 0;
  bool has_quotes = false;
  std::size_t first_line = 1;    ///< number of its first line, from 1
  std::size_t first_row = 0;     ///< number of its first data row, from 0
  std::uint64_t end_offset = 0;  ///< bytes of the file up to its end
  std::string_view text() const noexcept { return {storage.data(), size}; }
};

/// A table in memory, which the owner of the text keeps.
struct NamedText {
  std::string name;  ///< what messages call it
  std::string_view text;
};

/// A file that is being read, or standard input. Blocks come as soon as they hold one whole row,
/// so that a program that writes rows to a pipe and waits for answers gets them.
class Reader {
 public:
  /// Opens the file, `-` or nothing for standard input, and reads its header.
  /// @throws Error  the file cannot be opened, is a directory, has no header, or a bad one
  explicit Reader(const std::string& path);
  /// The same of a table in memory.
  /// @throws Error  it has no header, or a bad one
  explicit Reader(const NamedText& table);

  const Header& header() const noexcept { return *header_; }
  /// Size of a regular file, in bytes.
  std::optional<std::uint64_t> total_bytes() const noexcept { return total_bytes_; }

  /// The next rows. False at the end of the file, and after cancel(). Not for two threads at once.
  /// @throws Error  a failed read or a row that is too long
  bool read(Block& block);

  /// Ends a read() that waits for a slow pipe, and all later ones. From any thread.
  void cancel() noexcept;

 private:
  void open(const std::string& path);
  void skip_byte_order_mark();
  void read_header();
  bool fill(Block& block);
  std::size_t read_some(char* to, std::size_t size);
  [[noreturn]] void fail(std::string rule, std::size_t line = 0) const;
  [[noreturn]] void fail_too_long(std::string_view row) const;
  [[noreturn]] void fail_reading(int problem) const;

  std::string name_;
  std::optional<std::string_view> text_;  // of a table in memory: what is left of it
  Descriptor input_;
  Descriptor wake_;  // an eventfd, readable after cancel()
  std::atomic<bool> cancelled_ = false;
  std::optional<std::uint64_t> total_bytes_;
  std::vector<char> carry_;  // read, but not yet part of a block
  std::uint64_t offset_ = 0;
  std::size_t next_line_ = 1;
  std::size_t next_row_ = 0;
  std::optional<Header> header_;
};

/// Walks over the rows of a block.
class RowCursor {
 public:
  explicit RowCursor(const Header& header);

  /// Stands before the first row of the block, which must outlive the walk.
  void enter(const Block& block) noexcept;
  /// Goes to the next row; false after the last.
  /// @throws Error  a row with fewer or more cells than the header, or with a stray quote; next()
  ///                then goes on after it
  bool next();

  std::size_t index() const noexcept { return index_; }  ///< of the data row, from 0 in the file
  std::size_t line() const noexcept { return line_; }    ///< where it begins, from 1 in the file
  /// The cell without the spaces around it, or what stands between its quotes; valid until next().
  std::string_view text(Column column) const noexcept;
  /// @throws Error  a cell that parse_number() refuses
  double number(Column column) const;
  /// An error that names this row, the column and its value.
  Error error(Column column, std::string_view rule) const;

 private:
  void split(std::string_view row);
  void split_quoted(std::string_view row);
  [[noreturn]] void fail_length(std::size_t count) const;

  const Header* header_;
  std::vector<std::string_view> cells_;
  bool is_quoted_ = false;           // the row has quotes; its cells are then as they are meant
  std::vector<std::size_t> breaks_;  // of such a row: line breaks before each cell
  std::string unquoted_;             // of such a row: cells that had doubled quotes
  bool block_has_quotes_ = false;
  std::string_view rest_;
  std::size_t next_line_ = 1;
  std::size_t next_index_ = 0;
  std::size_t line_ = 0;
  std::size_t index_ = 0;
};

/// Calls function(const RowCursor&) for every row that is left, in order.
template <class Function>
void for_each_row(Reader& reader, Function&& function) {
  Block block;
  RowCursor row(reader.header());
  while (reader.read(block)) {
    row.enter(block);
    while (row.next()) function(row);
  }
}

/// Rows as text, collected in memory until they are taken to an OutputFile.
class RowText {
 public:
  void header(std::span<const std::string_view> names);
  /// One cell. Text holds no comma, quote, line end or leading `#` (asserted).
  void text(std::string_view cell);
  /// Cells that another RowText wrote, without a row's end.
  void cells(std::string_view written);
  void number(double value);  ///< finite (asserted)
  void integer(std::uint64_t value);
  void empty(std::size_t count = 1);
  void end_row();

  std::string_view view() const noexcept { return buffer_; }
  std::size_t size() const noexcept { return buffer_.size(); }
  void clear() noexcept { truncate(0); }
  /// Takes back everything after the first `size` bytes, which end a row.
  void truncate(std::size_t size) noexcept;

 private:
  void separate();

  std::string buffer_;
  bool at_row_start_ = true;
};

}  // namespace tangency::inline v0::tables
