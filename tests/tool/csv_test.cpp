// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/csv.hpp>
#include <tangency/tests/tool/process.hpp>

namespace tangency::tables {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Reads the columns x and y of a file with the given text.
Rows read_x_y(const std::string& text) {
  const testing::TemporaryFolder folder;
  Reader reader(folder.write("t.csv", text));
  const Column x = reader.header().require("x");
  const Column y = reader.header().require("y");
  Rows rows;
  for_each_row(reader, [&](const RowCursor& row) {
    EXPECT_EQ(row.index(), rows.size());
    rows.push_back({row.number(x), row.number(y)});
  });
  return rows;
}

/// The message of reading x and y, from the file's name on.
std::string refusal(const std::string& text) {
  try {
    read_x_y(text);
  } catch (const Error& error) {
    const std::string message = error.what();
    return message.substr(message.find("t.csv"));
  }
  return "accepted";
}

struct Sample {
  std::string name;
  std::string text;
  std::string message;  // of a refused text
};

void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.name; }

std::string name_of(const ::testing::TestParamInfo<Sample>& info) { return info.param.name; }

class AcceptedText : public ::testing::TestWithParam<Sample> {};
class RefusedText : public ::testing::TestWithParam<Sample> {};

TEST_P(AcceptedText, MeansTheSameTable) {
  EXPECT_EQ(read_x_y(GetParam().text), (Rows{{1, -2.5}, {3, 4}}));
}

INSTANTIATE_TEST_SUITE_P(
    Csv, AcceptedText,
    ::testing::ValuesIn(std::vector<Sample>{
        {"Plain", "x,y\n1,-2.5\n3,4\n", ""},
        {"LastLineWithoutEnd", "x,y\n1,-2.5\n3,4", ""},
        {"Crlf", "x,y\r\n1,-2.5\r\n3,4\r\n", ""},
        {"ByteOrderMark", "\xEF\xBB\xBFx,y\n1,-2.5\n3,4\n", ""},
        {"ByteOrderMarkBeforeComment", "\xEF\xBB\xBF# c\nx,y\n1,-2.5\n3,4\n", ""},
        {"SpacesAndTabs", "  x ,\ty\n 1\t, -2.5 \n3 ,4\n", ""},
        {"ColumnsTurned", "y,x\n-2.5,1\n4,3\n", ""},
        {"UnknownColumns", "name,x,y,\nn a n,1,-2.5,inf\n,3,4,\n", ""},
        {"UnnamedColumns", ",x,,y\n0,1,,-2.5\n1,3,,4\n", ""},
        {"Comments", "# one\nx,y\n#two, 1\n1,-2.5\n  # three\n3,4\n#", ""},
        {"BlankLines", "\n\nx,y\n\n1,-2.5\n \t\r\n3,4\n\n", ""},
        {"HexFloats", "x,y\n0x1p0,-0X1.4P+1\n+0x1.8p+1,0x4\n", ""},
        {"ManySpellings", "x,y\n+1.,-25e-1\n.3e+1,0004.000E0\n", ""},
        {"QuotedNames", "\"x\",\"y\"\n1,-2.5\n3,4\n", ""},
        {"QuotedNumbers", "x,y\n\"1\",\"-2.5\"\n 3 , \"4\" \r\n", ""},
        {"QuotedRowLabels", "\"\",\"x\",\"y\"\n\"1\",1,-2.5\n\"2\",3,4\n", ""},
        {"QuotedBehindAByteOrderMark", "\xEF\xBB\xBF\"x\",y\n1,-2.5\n3,4\n", ""},
        {"CommasInQuotes", "\"a, b\",x,y\n\"1, 2, 3\",1,-2.5\n\",\",3,4\n", ""},
        {"DoubledQuotes", "\"5\"\" pipe\",x,y\n\"\"\"\",1,-2.5\n\"\",3,4\n", ""},
        {"LineBreaksInQuotes", "\"a\n# b\",x,y\n\"1\n\n# 2\r\n\",1,-2.5\n\"#\",3,4\n", ""},
        {"QuotedCellIsNoComment", "\"#x\",x,y\n\"#\",1,-2.5\n# \"\n0,3,4\n", ""},
        {"QuotesInComments", "# 5\" pipe\nx,y\n1,-2.5\n#\"\n3,4\n", ""}}),
    name_of);

// geometry/tables/csv.hpp (3)
TEST_P(RefusedText, IsNamedWithPlaceValueAndRule) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

const std::string kNotANumber = ": a cell must hold a number, in decimal or as a hex float";
const std::string kRange =
    ": a number must be 0 or between 4.9e-324 and 1.8e308 in size, the range of a double";

const std::string kStrayQuote = ": a quote stands around a whole cell, and inside it twice";
const std::string kCommas = "; they must be by commas, and numbers have a decimal point";

INSTANTIATE_TEST_SUITE_P(
    Csv, RefusedText,
    ::testing::ValuesIn(std::vector<Sample>{
        {"EmptyCell", "x,y\n1,\n", "t.csv:2: y = (empty)" + kNotANumber},
        {"BlankCell", "x,y\n , 1\n", "t.csv:2: x = (empty)" + kNotANumber},
        {"Word", "x,y\n1,2\n1,two\n", "t.csv:3: y = two" + kNotANumber},
        {"TrailingRubbish", "x,y\n1,2mm\n", "t.csv:2: y = 2mm" + kNotANumber},
        {"TwoNumbersInACell", "x,y\n1,2 3\n", "t.csv:2: y = 2 3" + kNotANumber},
        {"TwoSigns", "x,y\n1,+-2\n", "t.csv:2: y = +-2" + kNotANumber},
        {"SignOnly", "x,y\n1,-\n", "t.csv:2: y = -" + kNotANumber},
        {"SignAfterHexPrefix", "x,y\n1,0x-2\n", "t.csv:2: y = 0x-2" + kNotANumber},
        {"HexPrefixOnly", "x,y\n1,0x\n", "t.csv:2: y = 0x" + kNotANumber},
        {"HexExponentMissing", "x,y\n1,0x1p\n", "t.csv:2: y = 0x1p" + kNotANumber},
        {"BlankInQuotes", "x,y\n1,\" 2\"\n", "t.csv:2: y =  2" + kNotANumber},
        {"NothingInQuotes", "x,y\n1,\"\"\n", "t.csv:2: y = (empty)" + kNotANumber},
        {"LineBreakInANumber", "x,y\n1,\"2\n\"\n", "t.csv:2: y = 2?" + kNotANumber},
        {"QuoteInsideACell", "x,y\n1,2\n1\"2,3\n", "t.csv:3: x = 1\"2" + kStrayQuote},
        {"QuoteInsideAnUnknownCell", "w,x,y\n5\" pipe,1,2\n",
         "t.csv:2: w = 5\" pipe" + kStrayQuote},
        {"QuoteInsideAName", "x\",y\n1,2\n", "t.csv:1: x\"" + kStrayQuote},
        {"MoreBehindAQuote", "x,y\n1,\"2\" 3\n",
         "t.csv:2: y = 2: a closing quote must be followed by a comma or the end of the row"},
        {"QuoteLeftOpen", "x,y\n1,2\n1,\"2\n3,4\n",
         "t.csv:3: y = 2?3,4?: a quote that is opened must be closed"},
        {"QuoteLeftOpenInTheHeader", "x,\"y\n1,2\n",
         "t.csv:1: y?1,2?: a quote that is opened must be closed"},
        {"EndlessQuote", "x,y\n1,2\n1,\"2\n" + std::string(kLongestLine + (1 << 18), '2'),
         "t.csv:3: a quote that is opened must be closed, and a row must be shorter than 1048576 "
         "bytes"},
        {"LinesCountInQuotes", "\"a\nb\",x,y\n\"\n\",1,2\n\"\n\",\"1\",q\n",
         "t.csv:6: y = q" + kNotANumber},
        {"ShortRowWithQuotes", "x,y\n\"1\"\n",
         "t.csv:2: 1 cell: a row must have as many cells as the header has columns, 2"},
        {"LongRowWithQuotes", "x,y\n\"1\",2,\n",
         "t.csv:2: 3 cells: a row must have as many cells as the header has columns, 2"},
        {"QuotedNameTwice", "x,y,\"x\"\n1,2,3\n", "t.csv:1: x: a column must be named only once"},
        {"Semicolons", "x;y\n1,5;2,5\n",
         "t.csv:1: the columns are separated by semicolons" + kCommas},
        {"QuotedSemicolons", "\"x\";\"y, m\"\n1;2\n",
         "t.csv:1: the columns are separated by semicolons" + kCommas},
        {"Tabs", "x\ty\n1\t2\n", "t.csv:1: the columns are separated by tabs" + kCommas},
        {"ControlCharacters", "x,y\n1,2\x01\x7F\n", "t.csv:2: y = 2?\?" + kNotANumber},
        {"LongCell", "x,y\n1," + std::string(70, 'z') + "\n",
         "t.csv:2: y = " + std::string(60, 'z') + "..." + kNotANumber},
        {"Nan", "x,y\n1,nan\n", "t.csv:2: y = nan: a number must be finite"},
        {"Infinity", "x,y\n-inf,1\n", "t.csv:2: x = -inf: a number must be finite"},
        {"TooLarge", "x,y\n1,1e999\n", "t.csv:2: y = 1e999" + kRange},
        {"TooLargeHex", "x,y\n1,0x1p1024\n", "t.csv:2: y = 0x1p1024" + kRange},
        {"TooSmall", "x,y\n1,-1e-999\n", "t.csv:2: y = -1e-999" + kRange},
        {"ShortRow", "x,y,z\n1,2,3\n1,2\n",
         "t.csv:3: 2 cells: a row must have as many cells as the header has columns, 3"},
        {"VeryShortRow", "x,y,z\n1\n",
         "t.csv:2: 1 cell: a row must have as many cells as the header has columns, 3"},
        {"LongRow", "x,y\n1,2,\n",
         "t.csv:2: 3 cells: a row must have as many cells as the header has columns, 2"},
        {"LinesCountWithCommentsAndBlanks", "#\n\nx,y\n#\n\n1,2\n1,q\n",
         "t.csv:7: y = q" + kNotANumber},
        {"ColumnNamedTwice", "# c\nx,y, x\n1,2,3\n",
         "t.csv:2: x: a column must be named only once"},
        {"ColumnMissing", "x,z\n1,2\n", "t.csv:1: y: this column is missing"},
        {"NothingAtAll", "", "t.csv: a header line that names the columns is missing"},
        {"OnlyComments", "#\n\n", "t.csv: a header line that names the columns is missing"},
        {"Utf16", std::string("\xFF\xFEx\0,\0y\0", 8),
         "t.csv: the text must be UTF-8; this looks like UTF-16"},
        {"EndlessLine", "x,y\n1,2\n1," + std::string(kLongestLine + (1 << 18), '2'),
         "t.csv:3: a line must be shorter than 1048576 bytes"}}),
    name_of);

TEST(CsvReader, NamesWhatItCannotOpen) {
  const auto problem = [](const std::string& path) -> std::string {
    try {
      const Reader reader(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "opened";
  };
  EXPECT_EQ(problem("/nonexistent/t.csv"),
            "/nonexistent/t.csv: cannot be read: No such file or directory");
  EXPECT_EQ(problem("/"), "/: cannot be read: Is a directory");
}

TEST(CsvReader, ErrorCarriesItsParts) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.write("t.csv", "x\n-1\n");
  Reader reader(path);
  for_each_row(reader, [&](const RowCursor& row) {
    const Fault fault = row.error(reader.header().require("x"), "must be > 0").fault();
    EXPECT_EQ(fault.file, path);
    EXPECT_EQ(fault.line, 2U);
    EXPECT_EQ(fault.column, "x");
    EXPECT_EQ(fault.value, "-1");
    EXPECT_EQ(fault.rule, "must be > 0");
  });
}

TEST(CsvReader, ReadsTheSameRowsFromMemoryAsFromAFile) {
  std::string text = "\xEF\xBB\xBFx,y\r\n# why\n\"1\",2\n";
  for (int i = 0; i < 100000; ++i) text += std::to_string(i) + ",0x1p-3\n";
  Reader reader(NamedText{"table", text});
  EXPECT_EQ(reader.total_bytes(), text.size());
  Rows rows;
  for_each_row(reader, [&](const RowCursor& row) {
    rows.push_back({row.number(Column{0}), row.number(Column{1})});
  });
  EXPECT_EQ(rows, read_x_y(text));
  try {
    const Reader empty(NamedText{"table", "# nothing\n"});
    ADD_FAILURE() << "a table must have a header";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "table: a header line that names the columns is missing");
  }
}

TEST(CsvReader, KeepsCountAcrossBlocks) {
  std::string text = "x,y\n";
  const std::size_t rows = 100'000;  // several blocks
  for (std::size_t i = 0; i < rows; ++i) {
    if (i % 7 == 0) text += "# between\n";
    text += std::to_string(i) + "," + std::to_string(i + 2 + i / 7) + "\n";
  }
  const testing::TemporaryFolder folder;
  Reader reader(folder.write("t.csv", text));
  const Column x = reader.header().require("x");
  const Column y = reader.header().require("y");
  std::size_t seen = 0;
  for_each_row(reader, [&](const RowCursor& row) {
    EXPECT_EQ(row.index(), seen);
    EXPECT_EQ(row.number(x), static_cast<double>(seen));
    // One header, and a comment for every seven rows begun.
    EXPECT_EQ(static_cast<double>(row.line()), row.number(y) + 1);
    ++seen;
  });
  EXPECT_EQ(seen, rows);
  EXPECT_EQ(reader.total_bytes(), text.size());
}

TEST(CsvReader, LineMayBeLongerThanABlock) {
  const std::string padding(600'000, ' ');
  EXPECT_EQ(read_x_y("x,y" + padding + "\n1" + padding + ",2\n3,4\n"), (Rows{{1, 2}, {3, 4}}));
}

TEST(CsvReader, GoesOnAfterARowOfTheWrongLength) {
  const testing::TemporaryFolder folder;
  Reader reader(folder.write("t.csv", "x,y\n1\n2,3\n"));
  Block block;
  ASSERT_TRUE(reader.read(block));
  RowCursor row(reader.header());
  row.enter(block);
  EXPECT_THROW(row.next(), Error);
  EXPECT_EQ(row.index(), 0U);
  ASSERT_TRUE(row.next());
  EXPECT_EQ(row.index(), 1U);
  EXPECT_EQ(row.line(), 3U);
  EXPECT_FALSE(row.next());
}

/// A table as a reader of RFC 4180 sees it that knows nothing of blocks and views: rows of cells,
/// or what is wrong and where. Written apart from the reader under test.
class PlainReader {
 public:
  struct Row {
    std::size_t line;
    std::vector<std::string> cells;
    std::size_t fault_line = 0;  ///< 0: none
  };

  explicit PlainReader(std::string text) : text_(std::move(text)) {
    while (at_ < text_.size()) {
      if (skip_blank_or_comment()) continue;
      rows_.push_back({line_, {}});
      while (cell(rows_.back())) {
      }
    }
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  char now() const { return at_ < text_.size() ? text_[at_] : '\n'; }
  bool over() const { return at_ >= text_.size(); }
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void step() {
    if (!over() && text_[at_] == '\n') ++line_;
    ++at_;
  }
  bool skip_blank_or_comment() {
    std::size_t i = at_;
    while (i < text_.size() && blank(text_[i])) ++i;
    const bool comment = i < text_.size() && text_[i] == '#';
    if (i < text_.size() && text_[i] != '\n' && !comment) return false;
    while (now() != '\n') step();
    step();
    return true;
  }
  /// One cell and the mark behind it; false at the row's end.
  bool cell(Row& row) {
    const std::size_t begin = line_;
    std::string text;
    bool bad = false;
    while (!over() && blank(now())) step();
    if (!over() && now() == '"') {
      bool closed = false;
      for (step(); !over() && !closed; step()) {
        if (text_[at_] == '"') {
          closed = at_ + 1 >= text_.size() || text_[at_ + 1] != '"';
          if (!closed) step();
        }
        if (!closed) text += text_[at_];
      }
      bad = !closed;
      for (; now() != ',' && now() != '\n'; step()) bad |= !blank(now());
    } else {
      for (; now() != ',' && now() != '\n'; step()) text += now();
      while (!text.empty() && blank(text.back())) text.pop_back();
      bad = text.find('"') != std::string::npos;
    }
    row.cells.push_back(text);
    if (bad && row.fault_line == 0) row.fault_line = begin;
    const bool more = !over() && now() == ',';
    step();
    return more;
  }

  std::string text_;
  std::size_t at_ = 0, line_ = 1;
  std::vector<Row> rows_;
};

/// A hostile table of three columns, of about that many rows.
std::string hostile_table(std::mt19937_64& random, std::size_t rows) {
  const auto one_of = [&](const auto& all) { return all[random() % std::size(all)]; };
  static constexpr const char* kCells[] = {"1",        "",        " a ",          "\"b\"",
                                           "\"\"",     "\"a,b\"", " \"c\"\t",     "\"q\"\"q\"",
                                           "\"\"\"\"", "\"\n\"",  "\"#\r\n #\"",  "\" d \"",
                                           "#e",       "f#",      "\"g\n,\"\"\"", "0x1.8p+3"};
  static constexpr const char* kFaults[] = {"a\"b", "\"a\"b", "\"a\" \"b\"", "x\"\"",
                                            "\"\"\"a\"\"b"};
  static constexpr const char* kBetween[] = {"\n", "# \" ,\n", "  #\n", " \t\r\n"};
  std::string text;
  for (std::size_t i = 0; i < rows; ++i) {
    if (random() % 5 == 0) text += one_of(kBetween);
    const std::size_t cells = random() % 12 == 0 ? 1 + random() % 5 : 3;
    for (std::size_t k = 0; k < cells; ++k) {
      text += k == 0 ? "" : ",";
      text += random() % 40 == 0 ? one_of(kFaults) : one_of(kCells);
    }
    text += random() % 3 == 0 ? "\r\n" : "\n";
  }
  if (random() % 2 == 0) text.pop_back();
  return text;
}

void expect_same_rows(const std::string& text) {
  const testing::TemporaryFolder folder;
  Reader reader(folder.write("t.csv", "x,y,z\n" + text));
  const std::vector<PlainReader::Row> expected = PlainReader("x,y,z\n" + text).rows();
  std::size_t index = 0;  // of the expected rows, the header before all
  Block block;
  RowCursor row(reader.header());
  while (reader.read(block)) {
    row.enter(block);
    for (bool more = true; more;) {
      std::size_t fault_line = 0;
      try {
        more = row.next();
        if (!more) break;
      } catch (const Error& error) {
        fault_line = error.fault().line;
      }
      ASSERT_LT(++index, expected.size());
      const PlainReader::Row& same = expected[index];
      ASSERT_EQ(row.index(), index - 1);
      ASSERT_EQ(row.line(), same.line);
      if (same.fault_line > 0 || same.cells.size() != 3) {
        ASSERT_EQ(fault_line, same.fault_line > 0 ? same.fault_line : same.line);
        continue;
      }
      ASSERT_EQ(fault_line, 0U) << same.line;
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(row.text(Column{k}), same.cells[k]);
    }
  }
  ASSERT_EQ(index + 1, expected.size());
}

TEST(CsvQuotes, AreReadAsByAReaderThatKnowsNothingElse) {
  constexpr unsigned kSeed = 20261129;
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  for (int table = 0; table < 500; ++table) {
    const std::string text = hostile_table(random, 1 + random() % 12);
    ASSERT_NO_FATAL_FAILURE(expect_same_rows(text)) << text;
  }
  // Several blocks, whose borders fall into quotes, doubled quotes and line breaks.
  for (int table = 0; table < 2; ++table) {
    ASSERT_NO_FATAL_FAILURE(expect_same_rows(hostile_table(random, 40'000))) << table;
  }
}

// geometry/tables/csv.hpp (4)
TEST(CsvQuotes, ThatNoCellNeedsChangeNothing) {
  std::mt19937_64 random(20261130);
  std::string plain = "x,y\n", quoted = plain;
  for (int i = 0; i < 30'000; ++i) {
    const std::string x = std::to_string(random() % 1000), y = "-" + std::to_string(i) + ".5e-3";
    plain += x + ',' + y + '\n';
    const bool first = random() % 2 == 0, second = random() % 2 == 0;
    quoted += (first ? '"' + x + '"' : x) + ',' + (second ? '"' + y + '"' : y) + '\n';
  }
  EXPECT_EQ(read_x_y(quoted), read_x_y(plain));
}

TEST(CsvQuotes, LetARowComeAsSoonAsItIsWhole) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.path("pipe");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const Descriptor writer(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  const auto write = [&](std::string_view text) {
    ASSERT_EQ(::write(writer.get(), text.data(), text.size()), std::ssize(text));
  };
  write("\"x\"\n");
  Reader reader(path);
  Block block;
  RowCursor row(reader.header());
  for (const std::string_view text : {"\"a\n", "b\"\"\"\n", "c\n"}) {
    write(text);
    if (text == "\"a\n") continue;  // not whole yet
    ASSERT_TRUE(reader.read(block));
    row.enter(block);
    ASSERT_TRUE(row.next());
    EXPECT_EQ(row.text(Column{0}), text == "c\n" ? "c" : "a\nb\"");
    EXPECT_FALSE(row.next());
  }
}

TEST(CsvReader, GivesTextCells) {
  const testing::TemporaryFolder folder;
  Reader reader(folder.write("t.csv", "row, status\n0, ok \n1,\n"));
  const Column status = reader.header().require("status");
  std::vector<std::string> read;
  for_each_row(reader, [&](const RowCursor& row) { read.emplace_back(row.text(status)); });
  EXPECT_EQ(read, (std::vector<std::string>{"ok", ""}));
}

/// Doubles of every size, from their bits.
class Doubles {
 public:
  double next() {
    for (;;) {
      const auto value = std::bit_cast<double>(bits_());
      if (std::isfinite(value)) return value;
    }
  }

 private:
  std::mt19937_64 bits_{20240607};
};

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

std::string format(const char* how, double value) {
  std::string text(400, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), how, value)));
  return text;
}

// geometry/tables/csv.hpp (1)
TEST(CsvNumbers, ReadBackToTheSameDouble) {
  using Limits = std::numeric_limits<double>;
  std::vector<double> values{0.0,  -0.0,        Limits::max(), Limits::min(), Limits::denorm_min(),
                             -0.1, 1 + 0x1p-52, 1e22,          0x1.fp-1060,   123456789.0};
  Doubles doubles;
  for (int i = 0; i < 100'000; ++i) values.push_back(doubles.next());
  for (const double value : values) {
    RowText row;
    row.number(value);
    double decimal = 0;
    double hex = 0;
    ASSERT_FALSE(parse_number(row.view(), decimal)) << row.view();
    ASSERT_FALSE(parse_number(format("%a", value), hex)) << format("%a", value);
    ASSERT_EQ(bits(decimal), bits(value)) << row.view();
    ASSERT_EQ(bits(hex), bits(value)) << row.view();
  }
}

// geometry/tables/csv.hpp (2)
TEST(CsvNumbers, AreReadCorrectlyRounded) {
  // The C library rounds correctly; texts with more digits than a double holds, and exact ties.
  Doubles doubles;
  for (int i = 0; i < 20'000; ++i) {
    const double value = doubles.next();
    const double halfway = value / 2 + std::nextafter(value, 0.0) / 2;
    for (const std::string& text :
         {format("%.17e", halfway), format("%.40e", value),
          format("%a", value)
              .insert(format("%a", value).find('p'), std::fabs(value) >= 0x1p-1022 ? "8" : "")}) {
      double read = 0;
      ASSERT_FALSE(parse_number(text, read)) << text;
      ASSERT_EQ(bits(read), bits(std::strtod(text.c_str(), nullptr))) << text;
    }
  }
  for (const char* tie : {"0x1.00000000000008p0", "0x1.00000000000018p0", "0x1.8p-1074",
                          "0x0.fffffffffffff8p-1022", "0x1.000000000000080000000000001p0",
                          "9007199254740993", "9007199254740993.0000000000000000000000001"}) {
    double read = 0;
    ASSERT_FALSE(parse_number(tie, read)) << tie;
    EXPECT_EQ(bits(read), bits(std::strtod(tie, nullptr))) << tie;
  }
}

TEST(CsvRowText, WritesCellsInOrder) {
  const std::vector<std::string_view> names{"row", "gap", "", "status"};
  RowText out;
  out.header(names);
  out.integer(18446744073709551615U);
  out.number(-0.25);
  out.empty();
  out.text("ok");
  out.end_row();
  const std::size_t whole = out.size();
  out.empty(3);
  out.truncate(whole);
  out.empty(2);
  out.end_row();
  EXPECT_EQ(out.view(), "row,gap,,status\n18446744073709551615,-0.25,,ok\n,\n");
}

}  // namespace
}  // namespace tangency::tables
