// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/tool/csv.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <ostream>
#include <random>

#include <tangency/tests/tool/process.hpp>

namespace tangency::csv {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Reads the columns x and y of a file with the given text.
Rows read_x_y(const std::string& text) {
  const test::TemporaryFolder folder;
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

std::string name_of(const testing::TestParamInfo<Sample>& info) { return info.param.name; }

class AcceptedText : public testing::TestWithParam<Sample> {};
class RefusedText : public testing::TestWithParam<Sample> {};

TEST_P(AcceptedText, MeansTheSameTable) {
  EXPECT_EQ(read_x_y(GetParam().text), (Rows{{1, -2.5}, {3, 4}}));
}

INSTANTIATE_TEST_SUITE_P(Csv, AcceptedText,
                         testing::ValuesIn(std::vector<Sample>{
                             {"Plain", "x,y\n1,-2.5\n3,4\n", ""},
                             {"LastLineWithoutEnd", "x,y\n1,-2.5\n3,4", ""},
                             {"Crlf", "x,y\r\n1,-2.5\r\n3,4\r\n", ""},
                             {"ByteOrderMark", "\xEF\xBB\xBFx,y\n1,-2.5\n3,4\n", ""},
                             {"ByteOrderMarkBeforeComment", "\xEF\xBB\xBF# c\nx,y\n1,-2.5\n3,4\n",
                              ""},
                             {"SpacesAndTabs", "  x ,\ty\n 1\t, -2.5 \n3 ,4\n", ""},
                             {"ColumnsTurned", "y,x\n-2.5,1\n4,3\n", ""},
                             {"UnknownColumns", "name,x,y,\nn a n,1,-2.5,inf\n,3,4,\n", ""},
                             {"UnnamedColumns", ",x,,y\n0,1,,-2.5\n1,3,,4\n", ""},
                             {"Comments", "# one\nx,y\n#two, 1\n1,-2.5\n  # three\n3,4\n#", ""},
                             {"BlankLines", "\n\nx,y\n\n1,-2.5\n \t\r\n3,4\n\n", ""},
                             {"HexFloats", "x,y\n0x1p0,-0X1.4P+1\n+0x1.8p+1,0x4\n", ""},
                             {"ManySpellings", "x,y\n+1.,-25e-1\n.3e+1,0004.000E0\n", ""}}),
                         name_of);

// geometry/tool/csv.hpp (3)
TEST_P(RefusedText, IsNamedWithPlaceValueAndRule) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

const std::string kNotANumber = ": a cell must hold a number, in decimal or as a hex float";
const std::string kRange =
    ": a number must be 0 or between 4.9e-324 and 1.8e308 in size, the range of a double";

INSTANTIATE_TEST_SUITE_P(
    Csv, RefusedText,
    testing::ValuesIn(std::vector<Sample>{
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
        {"QuotedNumber", "x,y\n1,\"2\"\n", "t.csv:2: y = \"2\"" + kNotANumber},
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
        {"QuotedName", "\"x\",y\n1,2\n",
         "t.csv:1: \"x\": names and numbers are written without quotes"},
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
  const test::TemporaryFolder folder;
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

TEST(CsvReader, KeepsCountAcrossBlocks) {
  std::string text = "x,y\n";
  const std::size_t rows = 100'000;  // several blocks
  for (std::size_t i = 0; i < rows; ++i) {
    if (i % 7 == 0) text += "# between\n";
    text += std::to_string(i) + "," + std::to_string(i + 2 + i / 7) + "\n";
  }
  const test::TemporaryFolder folder;
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
  const test::TemporaryFolder folder;
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

TEST(CsvReader, GivesTextCells) {
  const test::TemporaryFolder folder;
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

// geometry/tool/csv.hpp (1)
TEST(CsvNumbers, ReadBackToTheSameDouble) {
  using limits = std::numeric_limits<double>;
  std::vector<double> values{0.0,  -0.0,        limits::max(), limits::min(), limits::denorm_min(),
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

// geometry/tool/csv.hpp (2)
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
}  // namespace tangency::csv
