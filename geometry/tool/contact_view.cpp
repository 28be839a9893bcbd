// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/contact_view.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <system_error>
#include <utility>
#include <vector>

#include <tangency/geometry/tables/html_text.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/geometry/tool/contact_answers.hpp>

namespace tangency::inline v0::tool {
namespace {

using tables::escaped;

/// Beside what each row has, where the method is the first: found once, since they are of the pair.
constexpr const char* kOfPair = "mu,curvature_min,curvature_max";

/// Names and cells of an answer, in the order of the table.
using NamedCells = std::vector<std::pair<std::string, std::string>>;

const std::string& cell(const NamedCells& cells, std::string_view name) {
  return std::ranges::find(cells, name, [](const auto& one) { return one.first; })->second;
}

/// Names and cells of a row after its number, by the way that the table goes.
NamedCells answer_of(std::string_view method, MixedTerms mixed_terms, const tables::Header& header,
                     const tables::RowCursor& row) {
  const bool is_first = method == contact_methods().front();
  const ContactColumns further(contact_column_groups(), is_first ? kOfPair : "");
  std::vector<std::string_view> names(kContactColumns.begin() + 1, kContactColumns.end());
  further.append_names(names);
  const auto rows = bind_contact(method, mixed_terms, further)(header)();
  rows->read(row);
  rows->answer();
  tables::RowText text;
  rows->write(0, text);
  NamedCells cells;
  std::string_view rest = text.view();
  for (const std::string_view name : names) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    cells.emplace_back(name, rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return cells;
}

/// A pair, and the answer of each of contact_methods().
struct Pair {
  MatrixEllipsoid a, b;
  std::vector<NamedCells> answers;
};

/// @throws tables::Error  as write_contact_view()
Pair pair_of(const ContactView& view) {
  tables::Reader reader(view.input);
  const tables::Header& header = reader.header();
  const BodyColumns a(header, "a", view.mixed_terms), b(header, "b", view.mixed_terms);
  tables::Block block;
  tables::RowCursor row(header);
  std::size_t rows = 0;
  while (reader.read(block)) {
    row.enter(block);
    for (; row.next(); ++rows) {
      if (row.index() != view.row) continue;
      Pair pair{a.read(row), b.read(row), {}};
      for (const std::string& method : contact_methods())
        pair.answers.push_back(answer_of(method, view.mixed_terms, header, row));
      return pair;
    }
  }
  throw tables::Error({.file = header.file(),
                       .column = "--view",
                       .value = tables::to_text(view.row),
                       .rule = rows == 0
                                   ? "the table has no row"
                                   : "a row of the table, from 0 to " + tables::to_text(rows - 1)});
}

/// For eyes; the whole number is the title of its cell.
std::string shortened(const std::string& number, int digits) {
  double x = 0.0;
  const auto [end, fault] = std::from_chars(number.data(), number.data() + number.size(), x);
  return number.empty() || fault != std::errc() ? number : tables::rounded_text(x, digits);
}

std::string number_cell(const std::string& number, int digits = 7) {
  return "<td title=\"" + number + "\">" + shortened(number, digits) + "</td>";
}

std::string vector_cell(const NamedCells& cells, std::string_view x, std::string_view y,
                        std::string_view z) {
  std::string whole, brief;
  for (const std::string_view name : {x, y, z}) {
    const std::string& number = cell(cells, name);
    if (name != x) whole += ' ', brief += "<br>";
    whole += number;
    brief += shortened(number, 6);
  }
  return "<td title=\"" + whole + "\">" + brief + "</td>";
}

std::string gap_rows(const std::vector<NamedCells>& answers) {
  std::string rows;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const NamedCells& cells = answers[k];
    rows += "<tr data-method=\"" + contact_methods()[k] + "\"><th>" + contact_methods()[k] +
            "</th>" + number_cell(cell(cells, "gap")) + number_cell(cell(cells, "gap_error"), 2) +
            "<td>" + cell(cells, "status") + "</td></tr>\n";
  }
  return rows;
}

std::string point_rows(const std::vector<NamedCells>& answers) {
  std::string rows;
  for (std::size_t k = 0; k < answers.size(); ++k)
    rows += "<tr><th>" + contact_methods()[k] + "</th>" +
            vector_cell(answers[k], "nx", "ny", "nz") +
            vector_cell(answers[k], "pa.x", "pa.y", "pa.z") +
            vector_cell(answers[k], "pb.x", "pb.y", "pb.z") + "</tr>\n";
  return rows;
}

/// The ten numbers of a body, each rounded once where it is given by a matrix.
std::vector<std::string> numbers_of(const MatrixEllipsoid& body) {
  const Ellipsoid& e = body.ellipsoid();
  const Quaternion q = e.orientation();
  std::vector<std::string> numbers;
  for (const double x : {e.centre()[0], e.centre()[1], e.centre()[2], e.semi_axes()[0],
                         e.semi_axes()[1], e.semi_axes()[2], q.w(), q.x(), q.y(), q.z()})
    numbers.push_back(tables::to_text(x));
  return numbers;
}

std::string body_rows(const Pair& pair) {
  constexpr const char* kNames[] = {"x", "y", "z", "r1", "r2", "r3", "qw", "qx", "qy", "qz"};
  const auto a = numbers_of(pair.a), b = numbers_of(pair.b);
  std::string rows;
  for (std::size_t k = 0; k < a.size(); ++k)
    rows += std::string("<tr><th>") + kNames[k] + "</th><td>" + a[k] + "</td><td>" + b[k] +
            "</td></tr>\n";
  return rows;
}

/// What the programs draw, as JSON: numbers as the table has them, null for an empty cell.
std::string data_of(const Pair& pair) {
  const std::vector<NamedCells>& answers = pair.answers;
  const auto list = [](const MatrixEllipsoid& body) {
    std::string text;
    for (const std::string& number : numbers_of(body)) text += (text.empty() ? "" : ",") + number;
    return "[" + text + "]";
  };
  std::string text = "{\"a\":" + list(pair.a) + ",\"b\":" + list(pair.b) + ",\"gaps\":{";
  for (std::size_t k = 0; k < answers.size(); ++k) {
    text += (k ? ",\n\"" : "\n\"") + contact_methods()[k] + "\":{";
    for (const auto& [name, value] : answers[k]) {
      const bool is_word = name == "relation" || name == "status" || name == "inner";
      text += (text.back() == '{' ? "\"" : ",\"") + name + "\":" +
              (is_word         ? "\"" + value + "\""
               : value.empty() ? "null"
                               : value);
    }
    text += "}";
  }
  return text + "}}";
}

std::string relation_line(const NamedCells& cells) {
  const std::string& inner = cell(cells, "inner");
  return "<p>Relation, exact for the numbers of the table: <code id=\"relation\">" +
         cell(cells, "relation") + "</code>" +
         (inner.empty() ? "" : ", inside is <code>" + inner + "</code>") + ".</p>\n";
}

std::string sizes_line(const NamedCells& cells) {
  std::string text;
  if (!cell(cells, "mu").empty())
    text +=
        "Scaled by " + shortened(cell(cells, "mu"), 7) + " about their centres, both just touch. ";
  if (!cell(cells, "curvature_min").empty())
    text += "Curvature of the distance at the contact, least and largest: " +
            shortened(cell(cells, "curvature_min"), 6) + " and " +
            shortened(cell(cells, "curvature_max"), 6) + ".";
  return text.empty() ? "" : "<p>" + text + "</p>\n";
}

std::string page_of(const std::string& title, const Pair& pair) {
  const std::vector<NamedCells>& answers = pair.answers;
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>" +
      escaped(title) + "</title><style>\n";
  page.append(view_style()) += "</style></head><body>\n<h1>" + escaped(title) + "</h1>\n";
  page +=
      R"(<div class="parts"><div class="left">
<p id="says" role="status"></p>
<canvas id="scene" aria-label="The two bodies, their witness points and the normal from A to B"></canvas>
<div class="tools"><label>Points and normal by <select id="method"></select></label>
<label><input type="checkbox" id="with-spheres"> bounding spheres</label><button id="fit">Show both</button></div>
<p class="key"><b class="a">A</b> <b class="b">B</b> Dots: witness points. Arrow: the normal from A to B. Drag: turn. Wheel or two fingers: nearer.</p>
</div><div class="right">
)" + relation_line(answers.front()) +
      R"(<div class="wide"><table><thead><tr><th>gap by</th><td>gap</td><td>proven error</td><td>status</td></tr></thead><tbody id="gaps">
)" + gap_rows(answers) +
      "</tbody></table></div>\n" + sizes_line(answers.front()) +
      R"(<p class="small">A gap &gt; 0 is a distance, one &lt; 0 minus the depth. Numbers are shortened: under the mouse each has all its
digits, and so has what stands in the page for programs. What the methods mean: <code>tangency contact --help</code>.</p>
<details open><summary>Normal and witness points</summary><div class="wide"><table><thead><tr><th>by</th><td>normal</td><td>on A</td><td>on B</td></tr></thead><tbody>
)" + point_rows(answers) +
      R"(</tbody></table></div></details>
<details><summary>The bodies: centre, semi-axes, quaternion</summary><div class="wide"><table><thead><tr><th></th><td>A</td><td>B</td></tr></thead><tbody>
)" + body_rows(pair) +
      "</tbody></table></div></details>\n</div></div>\n" +
      "<script type=\"application/json\" id=\"pair\">" + data_of(pair) +
      "</script>\n<script>\n\"use strict\";\n";
  return page.append(view_script()) + "</script>\n</body></html>\n";
}

}  // namespace

tables::ExitStatus write_contact_view(const ContactView& view) {
  const Pair pair = pair_of(view);
  const std::string row = tables::to_text(view.row);
  const bool is_named = !view.input.empty() && view.input != "-";
  const std::string name = view.output.empty() ? "pair-" + row + ".html" : view.output;
  tables::OutputFile file(name);
  file.write(page_of("Row " + row + " of " + (is_named ? view.input : "standard input"), pair));
  file.commit();
  if (view.output.empty()) std::fprintf(stderr, "tangency: the pair is in %s\n", name.c_str());
  const std::string& status = cell(pair.answers.front(), "status");
  return status == "ok" || status == "local" ? tables::every_row_answered
                                             : tables::some_row_unanswered;
}

}  // namespace tangency::inline v0::tool
