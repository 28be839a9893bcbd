// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/geometry/image_gap.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tables/output_file.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>

namespace tangency::inline v0::tool {
namespace {

constexpr std::array<std::string_view, 20> kOutputColumns{
    "i",  "j",    "ix",   "iy",   "iz",   "row",  "relation", "gap",       "nx",     "ny",
    "nz", "pa.x", "pa.y", "pa.z", "pb.x", "pb.y", "pb.z",     "gap_error", "status", "inner"};
constexpr std::size_t kPairColumns = 5;

constexpr const char* kHelp = R"(
A table of bodies, one a row, which is read whole before the first answer. Its columns are
those of body a of `tangency contact`, without the a. and in any of the same forms:
  x y z r1 r2 r3   centre and semi-axes, and if it is turned
  qw qx qy qz      its orientation
  m.xx ...         or a shape matrix, p.xx ... its inverse, u1.x ... the vectors of the
                   semi-axes, A B ... K a quadric

Output, one row a pair of images that is listed, sorted by i, j and the image, each pair once:
  i j              numbers of the bodies' rows, from 0; i <= j
  ix iy iz         b is body j moved by the lengths of the cell times (ix, iy, iz): not by
                   rounded numbers. A body may meet its own image, i = j
and with --contacts the columns of `tangency contact` for body i as a and that image as b:
  row              number of the row of this output, from 0
  relation         exact
  gap nx ny nz pa.x pa.y pa.z pb.x pb.y pb.z gap_error status inner

Listed are without --reach the pairs that share a point, exactly: touching counts; with it
those whose gap, less its gap_error, is at most R.

A body that is larger than the cell meets images of itself, and many: a row with more than
--max-images of them is refused, before anything is searched. Counted are those whose bounding
boxes come within the reach: floor((2 r + R) / L) to either side along each axis that is periodic,
r the largest semi-axis.

The command does not take --keep-going: a list without a body that was refused would look whole.

Exit status: 0 the list is whole; 1 some contact is not_applicable, for a number beyond the
range of a double; 2 refused command line or input, or a failed read or write.

Example, three balls in a cell, of which the first meets an image of the last:
  $ cat bodies.csv
  x,y,z,r1,r2,r3
  1,1,1,1,1,1
  3,1,1,1,1,1
  5.5,1,1,1,1,1
  $ tangency neighbours --periodic 6,0,0 bodies.csv
  i,j,ix,iy,iz
  0,1,0,0,0
  0,2,-1,0,0
  $ tangency neighbours --contacts bodies.csv
  i,j,ix,iy,iz,row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner
  0,1,0,0,0,0,external_touch,0,1,0,0,2,1,1,2,1,1,0,ok,
  $ tangency neighbours --reach 0.5 bodies.csv
  i,j,ix,iy,iz
  0,1,0,0,0
  1,2,0,0,0
)";

/// Images of one body that are searched. Chosen: the list of a body that is 22 cells long has some
/// megabytes.
constexpr std::uint64_t kMaxImages = 100'000, kMostMaxImages = 1'000'000'000'000;

struct Options : QuadricOptions {
  std::string reach, periodic;
  std::uint64_t max_images = kMaxImages;
  bool contacts = false;
};

constexpr std::string_view kReachRule = "a reach must be >= 0";
constexpr std::string_view kPeriodicRule =
    "three lengths LX,LY,LZ, each >= 0, and 0 where the cell is open";

/// @return  what is wrong
std::string parse_lengths(const std::string& text, std::array<double, 3>& lengths) {
  std::size_t from = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t to = k < 2 ? text.find(',', from) : text.size();
    const bool ends_well = to != std::string::npos;
    if (!ends_well ||
        tables::parse_number(std::string_view(text).substr(from, to - from), lengths[k]) ||
        !(lengths[k] >= 0.0))
      return text + ": " + std::string(kPeriodicRule);
    from = to + 1;
  }
  return {};
}

Lattice lattice_of(const std::string& periodic) {
  Lattice lattice = Lattice::open();
  if (periodic.empty()) return lattice;
  std::array<double, 3> lengths{};
  parse_lengths(periodic, lengths);
  for (std::size_t k = 0; k < 3; ++k) {
    lattice.periodic[k] = lengths[k] > 0.0;
    const auto axis = static_cast<Eigen::Index>(k);
    if (lattice.periodic[k]) lattice.edges(axis, axis) = lengths[k];
  }
  return lattice;
}

/// Images of a body whose bounding boxes come within the reach of its own, itself included. It
/// meets no more images of a body that is not larger.
double images_near(const Ellipsoid& body, const Lattice& lattice, double reach) {
  const double width = 2.0 * body.largest_semi_axis() + reach;
  double images = 1.0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (lattice.periodic[static_cast<std::size_t>(k)])
      images *= 2.0 * std::floor(width / lattice.edges(k, k)) + 1.0;
  }
  return images;
}

/// The table, and what is asked of it.
struct Bodies {
  std::vector<Ellipsoid> round;        ///< MatrixEllipsoid::ellipsoid() of each
  bool exact = true;                   ///< are these the bodies themselves?
  std::vector<MatrixEllipsoid> given;  ///< where they are not
  std::string file;

  RelationAnswer relation(const NearPair& pair, const Mat3& edges) const {
    const auto& [a, b, image] = pair;
    return exact ? tangency::relation(round[a], round[b], edges, image)
                 : tangency::relation(given[a], given[b], edges, image);
  }
};

/// The question of the command line, but for its answers.
NeighbourQuestion question_of(const Options& options) {
  NeighbourQuestion question;
  question.lattice = lattice_of(options.periodic);
  question.threads = static_cast<int>(options.threads);
  if (!options.reach.empty()) tables::parse_number(options.reach, question.reach);
  return question;
}

Bodies read_bodies(const Options& options, const NeighbourQuestion& question) {
  tables::Reader reader(options.input);
  const BodyColumns columns(reader.header(), "", mixed_terms_named(options.mixed_terms));
  Bodies bodies;
  bodies.file = reader.header().file();
  bodies.exact = columns.has_axes();
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    MatrixEllipsoid body = columns.read(row);
    bodies.round.push_back(body.ellipsoid());
    const double images = images_near(bodies.round.back(), question.lattice, question.reach);
    if (images > static_cast<double>(options.max_images))
      throw tables::Error({.file = bodies.file,
                           .line = row.line(),
                           .column = "images",
                           .value = tables::to_text(images),
                           .rule = "a body may meet at most " + std::to_string(options.max_images) +
                                   " of its images (--max-images)"});
    if (!bodies.exact) bodies.given.push_back(std::move(body));
  });
  return bodies;
}

/// One contact of the list.
struct Contact {
  Gap gap;
  Vec3 point_a, point_b;
};

class Answers {
 public:
  Answers(const Bodies& bodies, NeighbourQuestion question, bool contacts)
      : bodies_(bodies), contacts_(contacts), question_(std::move(question)) {}

  tables::ExitStatus write(tables::OutputFile& out) {
    tables::RowText text;
    text.header(std::span(kOutputColumns).first(contacts_ ? kOutputColumns.size() : kPairColumns));
    const Neighbours found = search();
    for (std::size_t k = 0; k < found.size(); ++k) {
      write_pair(found, k, text);
      constexpr std::size_t kAtOnce = std::size_t{1} << 16;  // bytes; chosen
      if (text.size() < kAtOnce) continue;
      out.write(text.view());
      text.clear();
    }
    out.write(text.view());
    return unanswered_ ? tables::some_row_unanswered : tables::every_row_answered;
  }

 private:
  Neighbours search() const {
    NeighbourQuestion question = question_;
    question.accuracy = Accuracy::certified();
    if (contacts_) question.answers = NeighbourAnswers::contacts;
    try {
      return bodies_.exact ? neighbours(bodies_.round, question)
                           : neighbours(bodies_.given, question);
    } catch (const std::invalid_argument& refused) {
      throw tables::Error({.file = bodies_.file, .rule = refused.what()});
    }
  }

  Contact contact(const Neighbours& found, std::size_t k) const {
    const NearPair& pair = found.pairs[k];
    const Mat3& edges = question_.lattice.edges;
    const Vec3 &at_a = bodies_.round[pair.a].centre(), &at_b = bodies_.round[pair.b].centre();
    const Vec3 centre_b = separation(Vec3::Zero(), at_b, edges, pair.image).vector;
    const Gap gap{found.gap[k],       found.normal[k], found.arm_a[k], found.arm_b[k],
                  found.gap_error[k], found.status[k], GapTier::fast};
    return {gap, at_a + gap.arm_a, centre_b + gap.arm_b};
  }

  void write_pair(const Neighbours& found, std::size_t k, tables::RowText& text) {
    const NearPair& pair = found.pairs[k];
    text.integer(pair.a);
    text.integer(pair.b);
    for (const std::int32_t edges : pair.image) text.text(tables::to_text(edges));
    if (contacts_) {
      text.integer(row_++);
      write_contact(pair, contact(found, k), text);
    }
    text.end_row();
  }

  void write_contact(const NearPair& pair, const Contact& contact, tables::RowText& text) {
    const auto& [gap, point_a, point_b] = contact;
    const RelationAnswer exact = bodies_.relation(pair, question_.lattice.edges);
    text.text(to_string(exact.relation));
    const bool representable = std::isfinite(gap.gap) && std::isfinite(gap.gap_error) &&
                               point_a.allFinite() && point_b.allFinite();
    if (representable) {
      text.number(gap.gap);
      for (const Vec3* vector : {&gap.normal, &point_a, &point_b})
        for (const double component : *vector) text.number(component);
      text.number(gap.gap_error);
      text.text(gap.status == GapStatus::ok ? "ok" : "local");
    } else {
      text.empty(11);
      text.text("not_applicable");
      unanswered_ = true;
    }
    write_inner(exact.inner, text);
  }

  const Bodies& bodies_;
  const bool contacts_;
  NeighbourQuestion question_;
  std::size_t row_ = 0;
  bool unanswered_ = false;
};

std::string check_reach(const std::string& text) {
  double value = 0.0;
  if (const auto broken = tables::parse_number(text, value))
    return text + ": " + std::string(*broken);
  return value >= 0.0 ? std::string() : text + ": " + std::string(kReachRule);
}

}  // namespace

void add_neighbours(tables::Program& program) {
  const auto options = std::make_shared<Options>();
  tables::Command& command = program.subcommand(
      "neighbours", "Which bodies of a table, and images of them, touch or are near each other");
  command
      .option("--reach", options->reach, "List pairs whose gap is at most R (default: 0, a touch)")
      .check(check_reach)
      .type_name("R");
  command
      .option("--periodic", options->periodic,
              "The bodies repeat by these lengths along x, y and z; 0 along an open axis")
      .check([](const std::string& text) {
        std::array<double, 3> lengths{};
        return parse_lengths(text, lengths);
      })
      .type_name("LX,LY,LZ");
  command
      .option("--max-images", options->max_images,
              "The most images of one body that it may meet, itself included")
      .between(std::uint64_t{1}, kMostMaxImages)
      .shows_default()
      .type_name("N");
  command.flag("--contacts", options->contacts, "Add the columns of `tangency contact`");
  add_mixed_terms_option(command, *options);
  add_table_options(command, *options);
  command.footer(kHelp);
  command.runs([options] {
    tables::OutputFile out(options->output);
    const NeighbourQuestion question = question_of(*options);
    const Bodies bodies = read_bodies(*options, question);
    const tables::ExitStatus status = Answers(bodies, question, options->contacts).write(out);
    out.commit();
    return status;
  });
}

}  // namespace tangency::inline v0::tool
