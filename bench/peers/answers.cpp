// SPDX-License-Identifier: GPL-3.0-or-later
// Other codes as tools that `tangency-verify grade --tool` grades.
//
// peer_answers --list   a line a code, tab between: its name here, library, version, call and
//                       options, and the --definition that it is graded by
// peer_answers NAME     reads a table of pairs on standard input, answers it on standard output
//
// Each pair is prepared and asked in a process of its own. A pair of which a code says that it
// failed, or that ends the program or hangs it, has no line in the answers; the last line on
// standard error counts them.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <exception>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/peers/isolate.hpp>
#include <tangency/bench/peers/peer.hpp>
#include <tangency/geometry/tables/csv.hpp>

namespace {

using namespace tangency::peers;
namespace tables = tangency::tables;

/// Of processor time. Measured: on a busy machine FCL's signed distance takes up to 0.25 s for one
/// pair of the corpora that it answers; what takes longer does not come back.
constexpr double kAnswerPatience = 1;  // s

using Peers = std::vector<std::unique_ptr<Peer>>;

Peers graded_peers() {
  Peers peers = all_peers();
  for (auto* without_library : {&plain_perram_wertheim_peers, &bounding_spheres_peers})
    std::ranges::move(without_library(), std::back_inserter(peers));
  return peers;
}

/// Letters, digits and points; a hyphen for whatever stands between.
std::string name_of(const PeerDescription& d) {
  std::string name;
  for (const char c : d.name + ' ' + d.call + ' ' + d.options) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || (c == '.' && !name.ends_with('-'))) {
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!name.ends_with('-')) {
      name += '-';
    }
  }
  return name;
}

const char* definition_of(const PeerDescription& d) {
  switch (d.definition) {
    case Definition::common_normal:
      return "common-normal";
    case Definition::perram_wertheim:
      return "perram-wertheim";
    case Definition::portal:
      break;
  }
  return "centre-line";  // what a portal tends to
}

void list() {
  for (const auto& peer : graded_peers()) {
    const PeerDescription d = peer->description();
    std::printf("%s\t%s\t%s\t%s\t%s\t%s\n", name_of(d).c_str(), d.name.c_str(),
                d.version.empty() ? "-" : d.version.c_str(), d.call.c_str(), d.options.c_str(),
                definition_of(d));
  }
}

/// Prepared as late as it is asked, so that this too may end the program.
class LatePair final : public PeerPair {
 public:
  LatePair(const Peer& peer, const RawEllipsoid& a, const RawEllipsoid& b)
      : peer_(peer), a_(a), b_(b) {}
  std::optional<PeerContact> contact() override {
    try {
      return peer_.prepare(a_, b_)->contact();
    } catch (const std::exception&) {
      return {};
    }
  }

 private:
  const Peer& peer_;
  RawEllipsoid a_, b_;
};

std::array<tables::Column, 10> body_columns(const tables::Header& header, const std::string& who) {
  std::array<tables::Column, 10> columns{};
  std::ranges::transform(
      std::array{".x", ".y", ".z", ".r1", ".r2", ".r3", ".qw", ".qx", ".qy", ".qz"},
      columns.begin(), [&](const char* field) { return header.require(who + field); });
  return columns;
}

RawEllipsoid body(const tables::RowCursor& row, const std::array<tables::Column, 10>& columns) {
  std::array<double, 10> v{};
  std::ranges::transform(columns, v.begin(), [&](tables::Column c) { return row.number(c); });
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8], v[9]}};
}

std::vector<std::unique_ptr<PeerPair>> pairs_of(const Peer& peer) {
  tables::Reader reader("-");
  const auto a = body_columns(reader.header(), "a"), b = body_columns(reader.header(), "b");
  std::vector<std::unique_ptr<PeerPair>> pairs;
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    pairs.push_back(std::make_unique<LatePair>(peer, body(row, a), body(row, b)));
  });
  return pairs;
}

void write(std::size_t row, const PeerContact& contact, bool with_gap) {
  std::printf("%zu,%d", row, contact.overlap ? 1 : 0);
  if (with_gap) {
    contact.gap ? std::printf(",%.17g", *contact.gap) : std::printf(",");
    for (std::size_t k = 0; k < 3; ++k) {
      contact.normal ? std::printf(",%.17g", (*contact.normal)[k]) : std::printf(",");
    }
  }
  std::printf("\n");
}

void answer(const Peer& peer) {
  const bool with_gap = peer.description().gap_of != GapOf::none;
  const std::vector<Isolated> seen = ask_isolated(pairs_of(peer), kAnswerPatience);
  std::printf("row,overlaps%s\n", with_gap ? ",gap,nx,ny,nz" : "");
  std::array<int, 4> outcomes{};
  for (std::size_t i = 0; i < seen.size(); ++i) {
    ++outcomes[static_cast<std::size_t>(seen[i].outcome)];
    if (seen[i].contact) write(i, *seen[i].contact, with_gap);
  }
  std::fprintf(stderr, "%d pairs failed, %d ended the program, %d hung\n",
               outcomes[static_cast<std::size_t>(Outcome::failed)],
               outcomes[static_cast<std::size_t>(Outcome::aborted)],
               outcomes[static_cast<std::size_t>(Outcome::hung)]);
}

int run(const std::string& name) {
  for (const auto& peer : graded_peers()) {
    if (name_of(peer->description()) != name) continue;
    answer(*peer);
    return 0;
  }
  std::fprintf(stderr, "peer_answers: %s is no code; --list names all\n", name.c_str());
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: peer_answers --list | NAME\n", stderr);
    return 2;
  }
  try {
    if (std::string(argv[1]) != "--list") return run(argv[1]);
    list();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
