// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/corpus/corpus.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <vector>

#include <tangency/verify/corpus/cells.hpp>
#include <tangency/verify/corpus/formats.hpp>
#include <tangency/verify/corpus/neighbour_truth.hpp>
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
    CorpusInfo{"points", CorpusKind::points,
               "points outside, inside, on the surface and where closest points part"},
    CorpusInfo{"walls", CorpusKind::walls, "plane walls, near, through and touching"},
    CorpusInfo{"rays", CorpusKind::rays,
               "rays through, past and exactly along the surface, and from it"},
    CorpusInfo{"times", CorpusKind::times,
               "bodies that fly and turn, meet, pass, graze or touch at the start"},
    CorpusInfo{"matrices", CorpusKind::matrices, "pairs given by shape matrices"},
    CorpusInfo{"float32", CorpusKind::floats, "pairs whose every number is a float"},
    CorpusInfo{"neighbours", CorpusKind::neighbours, "bodies in open space"},
    CorpusInfo{"neighbours-periodic",
               CorpusKind::neighbours,
               "bodies in a cell of 80 x 16 x 8, periodic in all directions",
               {80, 16, 8}},
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

CorpusText started(const CorpusInfo& corpus, const Drawing& drawing, std::string_view about) {
  const std::string name(corpus.name);
  const std::string licence = "# SPDX-License-Identifier: CC0-1.0\n";
  const std::string made = "# Made by `tangency-verify generate " + name + drawing.options() + "`.";
  return {licence + "# Golden corpus " + name + ": " + std::string(corpus.what) + ".\n" + made +
              " Hex floats: exactly the doubles meant.\n",
          licence + "# What is true of " + name + ".csv.\n" + made + std::string(about)};
}

template <class Format, class Input>
CorpusText tables(const CorpusInfo& corpus, const std::vector<InputFamily<Input>>& families,
                  const Drawing& drawing) {
  CorpusText text = started(corpus, drawing, Format::about);
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

// Of neighbours. Every family has a box of its own, one after another along x.
CorpusText neighbour_tables(const CorpusInfo& corpus, const Drawing& drawing) {
  const bool periodic = corpus.cell != std::array<double, 3>{};
  std::vector<RawEllipsoid> bodies;
  std::vector<std::string> names;
  double box = 0;
  for (const auto& family : neighbour_families(periodic)) {
    const auto next = family.sequence(seed_of(corpus.name, family.name, drawing.seed));
    for (std::size_t k = 0; k < drawing.rows_of(family.count); ++k) {
      bodies.push_back(next());
      bodies.back().centre[0] += box;
      names.push_back(family.name);
    }
    box += kNeighbourBox;
  }
  CorpusText text = started(corpus, drawing,
                            " Pairs: exact, in integers (verify/oracles/relation.hpp). Columns:\n"
                            "# verify/corpus/corpus.hpp.\n");
  text.inputs += "x,y,z,r1,r2,r3,qw,qx,qy,qz,cell.x,cell.y,cell.z\n";
  text.truth += "row,family,j,ix,iy,iz,relation\n";
  const auto pairs = true_pairs(bodies, corpus.cell);
  auto pair = pairs.begin();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::string line;
    append_body(line, bodies[i]);
    append_hex(line, corpus.cell);
    text.inputs += line + '\n';
    const std::string head = std::to_string(i) + ',' + names[i] + ',';
    if (pair == pairs.end() || pair->i != i) text.truth += head + ",,,,\n";
    for (; pair != pairs.end() && pair->i == i; ++pair) {
      text.truth += head + std::to_string(pair->j);
      for (const int v : pair->image) text.truth += ',' + std::to_string(v);
      text.truth += ',' + std::string(name(pair->relation)) + '\n';
    }
  }
  return text;
}

// A row of which no more is known than the relation.
std::string relation_alone(const EllipsoidPair& pair) {
  const Real size = ascent::extent(separation(real(pair.a), real(pair.b)));
  return relation_cells(exact_relation(pair.a, pair.b)) + ',' + rounded_hex(size) +
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
  const auto made = [&]<class Format>(Format, const auto& families) {
    return tables<Format>(*found, families, drawing);
  };
  switch (found->kind) {
    case CorpusKind::pairs:
      break;
    case CorpusKind::ellipses:
      return made(EllipseFormat(), ellipse_families());
    case CorpusKind::quadrics:
      return made(QuadricFormat(), quadric_families());
    case CorpusKind::points:
      return made(PointFormat(), point_families());
    case CorpusKind::walls:
      return made(WallFormat(), wall_families());
    case CorpusKind::rays:
      return made(RayFormat(), ray_families());
    case CorpusKind::times:
      return made(TimeFormat(), time_families());
    case CorpusKind::matrices:
      return made(MatrixFormat(), matrix_families());
    case CorpusKind::floats:
      return made(FloatFormat(), float_families());
    case CorpusKind::neighbours:
      return neighbour_tables(*found, drawing);
  }
  return made(PairFormat(), pair_families(name, seed));
}

}  // namespace tangency::inline v0::verify
