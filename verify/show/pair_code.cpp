// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/show/pair_code.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::verify {
namespace {

// A hex float of C99, C++17 and Python's fromhex().
std::string hex(double value) {
  return (std::signbit(value) ? "-0x" : "0x") +
         tables::to_text(std::abs(value), std::chars_format::hex);
}

std::string list(std::span<const double> numbers, const char* separator) {
  std::string text;
  for (const double v : numbers) text += (text.empty() ? "" : separator) + hex(v);
  return text;
}

std::string cpp_body(const char* name, const RawEllipsoid& body) {
  return std::string("  const tangency::Ellipsoid ") + name + "({" + list(body.centre, ", ") +
         "},\n                              {" + list(body.semi_axes, ", ") +
         "},\n                              {" + list(body.orientation, ", ") + "});\n";
}

std::string cpp(const Solids& pair, const std::string& title, const std::string& truth) {
  return "// " + title + "\n// true: " + truth +
         "\n#include <iostream>\n\n#include <tangency/geometry/gap.hpp>\n"
         "#include <tangency/geometry/relation.hpp>\n\nint main() {\n" +
         cpp_body("a", pair.a) + cpp_body("b", pair.b) +
         "  const tangency::Gap gap = signed_gap(a, b);\n"
         "  std::cout.precision(17);\n"
         "  std::cout << to_string(relation(a, b).relation) << '\\n'\n"
         "            << gap.gap << \" +- \" << gap.gap_error << \" along \" << "
         "gap.normal.transpose() << '\\n';\n}\n";
}

std::string row(const RawEllipsoid& body, const char* separator) {
  return list(body.centre, separator) + separator + list(body.semi_axes, separator) + separator +
         list(body.orientation, separator);
}

std::string c(const Solids& pair, const std::string& title, const std::string& truth) {
  return "/* " + title + "\n   true: " + truth +
         " */\n#include <stdio.h>\n#include <tangency.h>\n\nint main(void) {\n"
         "  /* x y z r1 r2 r3 qw qx qy qz */\n  const double a[10] = {" +
         row(pair.a, ", ") + "};\n  const double b[10] = {" + row(pair.b, ", ") +
         "};\n  double gap, gap_error, normal[3];\n"
         "  tangency_contact_columns answers = {sizeof(tangency_contact_columns)};\n"
         "  answers.gap = &gap;\n  answers.gap_error = &gap_error;\n  answers.normal = normal;\n"
         "  if (tangency_contacts_of_rows(a, sizeof a, b, sizeof b, 1, NULL, &answers, 1) != "
         "TANGENCY_OK) {\n"
         "    fprintf(stderr, \"%s\\n\", tangency_error_message());\n    return 1;\n  }\n"
         "  printf(\"%.17g +- %.17g along %.17g %.17g %.17g\\n\", gap, gap_error, normal[0], "
         "normal[1], normal[2]);\n  return 0;\n}\n";
}

std::string python(const Solids& pair, const std::string& title, const std::string& truth) {
  const auto body = [](const char* name, const RawEllipsoid& one) {
    return std::string(name) + " = [float.fromhex(v) for v in (\"" + row(one, " ") +
           "\").split()]\n";
  };
  return "# " + title + "\n# true: " + truth +
         "\nimport tangency\n\n# x y z r1 r2 r3 qw qx qy qz\n" + body("a", pair.a) +
         body("b", pair.b) +
         "found = tangency.contact(a, b)\n"
         "print(found.gap, \"+-\", found.gap_error, \"along\", *found.normal)\n";
}

double largest(const RawEllipsoid& body) { return std::ranges::max(body.semi_axes); }

std::string decimals(std::span<const double> numbers, double factor = 1) {
  std::string text;
  for (const double v : numbers) text += ' ' + tables::to_text(factor * v);
  return text;
}

std::string lammps(const Solids& pair, const std::string& title, const std::string& truth) {
  std::string text =
      "# " + title + "; true: " + truth + "\n\n2 atoms\n2 ellipsoids\n1 atom types\n\n";
  for (std::size_t k = 0; k < 3; ++k) {
    const double low =
        std::min(pair.a.centre[k] - largest(pair.a), pair.b.centre[k] - largest(pair.b));
    const double high =
        std::max(pair.a.centre[k] + largest(pair.a), pair.b.centre[k] + largest(pair.b));
    const char axis = "xyz"[k];
    // An end that rounding would put on a body's own is a little further out.
    const double margin = (high - low) / 16;
    text += tables::to_text(low - margin) + ' ' + tables::to_text(high + margin) + ' ' + axis +
            "lo " + axis + "hi\n";
  }
  std::string shapes;
  text += "\nAtoms # ellipsoid: id type ellipsoidflag density x y z\n\n";
  for (const auto& [id, body] : {std::pair("1", &pair.a), std::pair("2", &pair.b)}) {
    text += std::string(id) + " 1 1 1" + decimals(body->centre) + '\n';
    shapes += id + decimals(body->semi_axes, 2) + decimals(body->orientation) + '\n';
  }
  return text + "\nEllipsoids # id and diameters, quaternion w x y z\n\n" + shapes;
}

}  // namespace

std::string as_code(std::string_view code, const Solids& pair, const std::string& title,
                    const std::string& truth) {
  if (code == "cpp") return cpp(pair, title, truth);
  if (code == "c") return c(pair, title, truth);
  if (code == "python") return python(pair, title, truth);
  assert(code == "lammps");
  return lammps(pair, title, truth);
}

}  // namespace tangency::inline v0::verify
