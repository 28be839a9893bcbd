// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/corpus.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <exception>
#include <ios>
#include <stdexcept>
#include <vector>

#include <tangency/verify/corpus/truth.hpp>
#include <tangency/verify/families/families.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr std::array kCorpora{
    CorpusInfo{"classes", CorpusKind::pairs,
               "shallow contacts of moderate to extreme shapes, the published classes 1 to 3"},
    CorpusInfo{"near", CorpusKind::pairs,
               "gaps of either sign, 1e-3 to 1e-17 of the smallest semi-axis"},
    CorpusInfo{"touching", CorpusKind::pairs,
               "exact external touches, their neighbours in the grid of doubles, and both at "
               "extremes"},
    CorpusInfo{"symmetric", CorpusKind::pairs,
               "spheres, equal and parallel axes, a common axis or plane"},
    CorpusInfo{"nested", CorpusKind::pairs,
               "one inside the other, touches from inside, common centres, equal sets"},
    CorpusInfo{"extreme", CorpusKind::pairs, "needles, discs, sizes, scales, far origins"},
    CorpusInfo{"deep", CorpusKind::pairs,
               "overlaps of any depth, where several local answers compete"},
    CorpusInfo{
        "profiles", CorpusKind::pairs,
        "displacement profiles: equal spheroids in contact, moved along, across, and turned"},
    CorpusInfo{"ellipses", CorpusKind::ellipses, "plane ellipses in general and special places"},
    CorpusInfo{"quadrics", CorpusKind::quadrics,
               "quadrics of every type, and what lies beside their borders"},
};

constexpr int kDigits = 40;

// Correctly rounded to 40 significant digits, without trailing zeros.
std::string decimal(const Real& v) {
  if (v == 0) return "0";
  std::string text = v.str(kDigits - 1, std::ios::scientific);
  const std::size_t exponent = text.find('e');
  std::size_t last = text.find_last_not_of('0', exponent - 1);
  if (text[last] == '.') --last;
  text.erase(last + 1, exponent - last - 1);
  if (text.ends_with("e+00")) text.resize(text.size() - 4);
  return text;
}

// Of a unit vector: what is left of nothing after 150 digits is nothing.
std::string component(const Real& v) { return decimal(abs(v) < Real("1e-60") ? Real(0) : v); }

std::string components(const Real3& n) {
  return component(n[0]) + ',' + component(n[1]) + ',' + component(n[2]);
}

std::string hex(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), std::abs(value),
                                 std::chars_format::hex)
                       .ptr;
  return (value < 0 ? "-0x" : "0x") + std::string(digits.data(), end);
}

template <class Numbers>
void append_hex(std::string& line, const Numbers& numbers) {
  for (const double v : numbers) line += (line.empty() ? "" : ",") + hex(v);
}

// Part of a truth line behind row and family; one line each.
using TruthLines = std::vector<std::string>;

std::string relation_cells(const ExactRelation& exact) {
  std::string cells(name(exact.relation));
  cells += exact.inner == Inner::a ? ",a" : exact.inner == Inner::b ? ",b" : ",";
  return cells;
}

struct PairFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,"
      "b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz";
  static constexpr std::string_view truth =
      "relation,inner,size,gap,normals,nx,ny,nz,ax,ay,az,pw.gap,pw.nx,pw.ny,pw.nz,mp.gap,cl.gap";

  static std::string input(const EllipsoidPair& pair) {
    std::string line;
    for (const RawEllipsoid* e : {&pair.a, &pair.b}) {
      append_hex(line, e->centre), append_hex(line, e->semi_axes), append_hex(line, e->orientation);
    }
    return line;
  }
  static TruthLines lines(const EllipsoidPair& pair) {
    const auto truth = pair_truth(pair);
    if (!truth) return {};
    const std::string head = relation_cells(truth->relation) + ',' +
                             hex(truth->size.convert_to<double>()) + ',' + decimal(truth->gap);
    std::string tail = ",,,,,,";
    if (const auto& pw = truth->perram_wertheim) {
      const bool touch = truth->relation.relation == Relation::external_touch;
      const auto number = [&](const Real& v) { return touch ? "0" : decimal(v); };
      tail = ',' + number(pw->tangent_planes.gap) + ',' + components(pw->tangent_planes.normal) +
             ',' + (pw->midpoint ? number(pw->midpoint->gap) : "") + ',' + number(pw->centre_line);
    }
    TruthLines lines;
    for (const TrueNormals& n : truth->normals) {
      using Set = TrueNormals::Set;
      const std::string set = n.set == Set::point    ? ",point,"
                              : n.set == Set::circle ? ",circle,"
                                                     : ",all,";
      lines.push_back(head + set + (n.set == Set::all ? ",," : components(n.normal)) + ',' +
                      (n.set == Set::circle ? components(n.axis) : ",,") + tail);
    }
    return lines;
  }
};

struct EllipseFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.r1,a.r2,a.ux,a.uy,b.x,b.y,b.r1,b.r2,b.ux,b.uy";
  static constexpr std::string_view truth =
      "relation,inner,crossings,size,area,smaller_area,gap,normals,nx,ny";

  static std::string input(const EllipsePair& pair) {
    std::string line;
    for (const RawEllipse* e : {&pair.a, &pair.b}) {
      append_hex(line, e->centre), append_hex(line, e->semi_axes), append_hex(line, e->direction);
    }
    return line;
  }
  static TruthLines lines(const EllipsePair& pair) {
    const EllipsePairTruth truth = ellipse_truth(pair);
    const auto rounded = [](const Real& v) { return hex(v.convert_to<double>()); };
    const std::string head = relation_cells(truth.relation) + ',' +
                             (truth.crossings < 0 ? "" : std::to_string(truth.crossings)) + ',' +
                             rounded(truth.size) + ',' + rounded(truth.area) + ',' +
                             rounded(truth.smaller_area) + ',' + decimal(truth.gap.gap);
    if (truth.gap.every_normal) return {head + ",all,,"};
    TruthLines lines;
    for (const auto& [x, y] : truth.gap.normals) {
      lines.push_back(head + ",point," + component(x) + ',' + component(y));
    }
    return lines;
  }
};

struct QuadricFormat {
  static constexpr std::string_view inputs = "A,B,C,D,E,F,G,H,J,K";
  static constexpr std::string_view truth = "type";

  static std::string input(const RawQuadric& q) {
    std::string line;
    append_hex(line, std::array{q.A, q.B, q.C, q.D, q.E, q.F, q.G, q.H, q.J, q.K});
    return line;
  }
  static TruthLines lines(const RawQuadric& q) { return {std::string(name(classify(q).type))}; }
};

// FNV-1a: every family has a seed of its own, whatever stands before it.
std::uint64_t seed_of(std::string_view corpus, std::string_view family, std::uint64_t seed) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::string_view text : {corpus, family}) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  for (; seed > 0; seed >>= 8) hash = (hash ^ (seed & 0xff)) * 0x100000001b3;
  return hash;
}

// What to draw: how many rows of a family, and from which seed.
struct Drawing {
  std::size_t rows;
  std::uint64_t seed;

  std::size_t rows_of(std::size_t committed) const {
    return rows == kWholeFamily ? committed : rows;
  }
  std::string options() const {
    if (seed == 0) return {};
    return " --seed " + std::to_string(seed) +
           (rows == kWholeFamily ? "" : " --rows " + std::to_string(rows));
  }
};

CorpusText started(const CorpusInfo& corpus, const Drawing& drawing) {
  const std::string name(corpus.name);
  const std::string licence = "# SPDX-License-Identifier: CC0-1.0\n";
  const std::string made = "# Made by `tangency-verify generate " + name + drawing.options() + "`.";
  std::string truth;
  switch (corpus.kind) {
    case CorpusKind::pairs:
      truth =
          " Relation: exact, in integers (verify/oracles/relation.hpp).\n"
          "# Gap and normals: 40 digits of 150 (verify/oracles/gap.hpp, verify/corpus/"
          "coaxial.hpp), a line for every normal\n# that reaches the gap; pw, mp, cl:"
          " verify/oracles/perram_wertheim.hpp. Columns: verify/corpus/corpus.hpp.\n";
      break;
    case CorpusKind::ellipses:
      truth =
          " Relation and crossings: exact; area: 18 digits, rounded to\n# double; gap and normals:"
          " 40 digits of 150, a line for every normal that reaches the gap\n"
          "# (verify/oracles/ellipse.hpp). Columns: verify/corpus/corpus.hpp.\n";
      break;
    default:
      truth = " Types: exact, in integers (verify/oracles/classification.hpp).\n";
      break;
  }
  return {licence + "# Golden corpus " + name + ": " + std::string(corpus.what) + ".\n" + made +
              " Hex floats: exactly the doubles meant.\n",
          licence + "# What is true of " + name + ".csv.\n" + made + truth};
}

template <class Format, class Input>
CorpusText tables(const CorpusInfo& corpus, const std::vector<InputFamily<Input>>& families,
                  const Drawing& drawing) {
  CorpusText text = started(corpus, drawing);
  text.inputs += std::string(Format::inputs) + '\n';
  text.truth += "row,family," + std::string(Format::truth) + '\n';
  std::size_t row = 0;
  for (const InputFamily<Input>& family : families) {
    const auto next = family.sequence(seed_of(corpus.name, family.name, drawing.seed));
    for (std::size_t i = 0; i < drawing.rows_of(family.count); ++i, ++row) {
      Input input = next();
      TruthLines lines = Format::lines(input);
      while (lines.empty()) lines = Format::lines(input = next());
      text.inputs += Format::input(input) + '\n';
      for (const std::string& line : lines) {
        text.truth += std::to_string(row) + ',' + family.name + ',' + line + '\n';
      }
    }
  }
  return text;
}

// A row of which no more is known than the relation.
std::string relation_alone(const EllipsoidPair& pair) {
  const Real size = ascent::extent(separation(real(pair.a), real(pair.b)));
  return relation_cells(exact_relation(pair.a, pair.b)) + ',' + hex(size.convert_to<double>()) +
         std::string(std::ranges::count(PairFormat::truth, ',') - 2, ',');
}

}  // namespace

std::span<const CorpusInfo> corpora() { return kCorpora; }

std::string_view pair_columns() { return PairFormat::inputs; }
std::string pair_cells(const EllipsoidPair& pair) { return PairFormat::input(pair); }

CorpusText corpus_of(std::span<const NamedPair> pairs, std::string_view comment) {
  const std::string head = "# " + std::string(comment) + '\n';
  CorpusText text{head + std::string(PairFormat::inputs) + '\n',
                  head + "row,family," + std::string(PairFormat::truth) + '\n'};
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    const auto& [family, note, pair] = pairs[row];
    TruthLines lines;
    try {
      lines = PairFormat::lines(pair);
    } catch (const std::exception&) {
      // An ascent of the oracle that did not arrive.
    }
    if (lines.empty()) lines = {relation_alone(pair)};
    const std::string above = "# row " + std::to_string(row) + ": " + note + '\n';
    text.inputs += above + PairFormat::input(pair) + '\n';
    text.truth += above;
    for (const std::string& line : lines) {
      text.truth += std::to_string(row) + ',' + family + ',' + line + '\n';
    }
  }
  return text;
}

CorpusText generate(std::string_view name, std::size_t rows, std::uint64_t seed) {
  const Drawing drawing{rows, seed};
  const auto found = std::ranges::find(kCorpora, name, &CorpusInfo::name);
  if (found == kCorpora.end()) throw std::invalid_argument("no corpus has this name");
  switch (found->kind) {
    case CorpusKind::pairs:
      return tables<PairFormat>(*found, pair_families(name, seed), drawing);
    case CorpusKind::ellipses:
      return tables<EllipseFormat>(*found, ellipse_families(), drawing);
    default:
      break;
  }
  return tables<QuadricFormat>(*found, quadric_families(), drawing);
}

}  // namespace tangency::inline v0::verify
