// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/strain_report.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include <tangency/dem/saved/state_file.hpp>
#include <tangency/dem/tool/sliding.hpp>
#include <tangency/dem/tool/text_columns.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

namespace mm = micromechanics;
using Json = nlohmann::ordered_json;

mm::PeriodicCentres centres_of(const Packing& packing) {
  return {packing.particles.position, packing.edges, packing.dimensions};
}

mm::PeriodicPairs pairs_of(const Packing& packing) {
  return {packing.contacts.bodies, packing.contacts.image};
}

/// The nets of a packing, and what each says; `say` adds it to the rest.
using Say = std::function<void(const mm::StrainMesh&, StrainOfNet&)>;

StrainOfNet net_of(const std::string& name, const std::function<mm::StrainMesh()>& make,
                   const Say& say) {
  StrainOfNet net;
  net.name = name;
  try {
    const mm::StrainMesh mesh = make();
    net.cells = mesh.cells;
    net.centres = mesh.centres;
    net.edges = mesh.edges.size();
    say(mesh, net);
  } catch (const mm::NoMesh& none) {
    net.why_not = none.what();
  }
  return net;
}

std::vector<StrainOfNet> nets_of(const Packing& packing, const Say& say) {
  const mm::PeriodicCentres centres = centres_of(packing);
  std::vector<StrainOfNet> nets;
  const bool is_plane = packing.dimensions == 2;
  if (is_plane)
    nets.push_back(net_of(
        "polygons",
        [&] { return mm::polygon_mesh(centres, pairs_of(packing), packing.contacts.arm); }, say));
  nets.push_back(net_of(
      is_plane ? "triangles" : "tetrahedra",
      [&] { return mm::simplex_mesh(centres, mm::delaunay_simplices(centres)); }, say));
  return nets;
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw StateError(file + ": " + what);
}

/// By ids.
std::vector<double> masses_of(const State& state) {
  std::vector<double> masses;
  for (const std::uint32_t i : state.particles.index_of_id())
    masses.push_back(state.particles.mass[i]);
  return masses;
}

/// Are positions those of the same particles, at an earlier time?
void require_older(const State& state, const Packing& now, const State& older, const Packing& then,
                   const std::string& file) {
  if (then.dimensions != now.dimensions)
    refuse(file, "a state of " + std::to_string(then.dimensions) +
                     " dimensions; the later one has " + std::to_string(now.dimensions));
  if (then.particles.size() != now.particles.size())
    refuse(file, "a state of " + std::to_string(then.particles.size()) +
                     " particles; the later one has " + std::to_string(now.particles.size()));
  if (older.cycle > state.cycle)
    refuse(file, "a state of cycle " + std::to_string(older.cycle) +
                     "; --since takes one from before cycle " + std::to_string(state.cycle));
  const std::vector<double> masses = masses_of(state), masses_then = masses_of(older);
  for (std::size_t i = 0; i < now.particles.size(); ++i) {
    const std::string particle = "particle " + std::to_string(i);
    if (then.particles.type[i] != now.particles.type[i])
      refuse(file, particle + " is of another type than in the later state");
    if (masses_then[i] != masses[i])  // which growth keeps
      refuse(file, particle + " has the mass " + tables::to_text(masses_then[i]) +
                       ", in the later state " + tables::to_text(masses[i]));
  }
}

}  // namespace

StrainReport strain_report(const State& state, const Packing& packing) {
  StrainReport report;
  report.rate = state.cell.rate;
  if (state.cell.has_walls())
    report.why_not = "nets are of cells that are periodic along every axis";
  if (packing.particles.size() == 0) report.why_not = "no particle";
  if (!report.why_not.empty()) return report;
  mm::ContactMotion motion{pairs_of(packing),
                           packing.contacts.normal,
                           packing.contacts.arm,
                           {},
                           packing.particles.velocity,
                           packing.particles.angular_velocity,
                           state.cell.rate};
  const std::vector<Vec3> sliding =
      sliding_of(packing, state.laws, mm::contact_velocities(motion, centres_of(packing)));
  motion.sliding = sliding;
  report.of_velocities = nets_of(packing, [&](const mm::StrainMesh& mesh, StrainOfNet& net) {
    net.parts = mm::strain_parts(mesh, centres_of(packing), motion);
  });
  return report;
}

namespace {

/// A packing with edges and images as an older state describes its cell, whose lattice is the same.
Packing described_as(const State& older, const State& state, Packing packing) {
  const Reset back = state.description.inverse().then(older.description);
  packing.edges = back.edges(packing.edges);
  for (Image& image : packing.contacts.image) image = back.image(image);
  return packing;
}

}  // namespace

StrainReport strain_report(const State& state, const Packing& now, const State& older,
                           const std::string& file) {
  const Packing then = packing_of(older);
  require_older(state, now, older, then, file);
  StrainReport report = strain_report(state, now);
  if (!report.why_not.empty()) return report;
  const Packing packing = described_as(older, state, now);
  StrainReport::Since since;
  since.cycle = older.cycle;
  since.time = older.time;
  since.gradient = packing.edges * then.edges.inverse() - Mat3::Identity();
  Cell cell = state.cell;
  cell.edges = packing.edges;
  cell.reference_edges = then.edges;
  since.logarithmic = cell.logarithmic_strain();
  since.nets = nets_of(then, [&](const mm::StrainMesh& mesh, StrainOfNet& net) {
    net.since = mm::strain_of_edges(mesh, mm::displacement_differences(mesh, centres_of(packing)),
                                    pairs_of(then), pairs_of(packing));
  });
  report.since = std::move(since);
  return report;
}

namespace {

/// Compression positive, zeros without sign.
Json tensor(const Mat3& extension) {
  const Mat3 m = Mat3::Zero() - extension;
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2)});
  return rows;
}

Json net_json(const StrainOfNet& net) {
  Json to{{"net", net.name}};
  to["why_not"] = net.why_not.empty() ? Json(nullptr) : Json(net.why_not);
  if (!net.why_not.empty()) return to;
  to["cells"] = net.cells;
  to["centres"] = net.centres;
  to["edges"] = net.edges;
  return to;
}

Json velocities_json(const StrainReport& report) {
  Json nets = Json::array();
  for (const StrainOfNet& net : report.of_velocities) {
    Json to = net_json(net);
    if (net.why_not.empty()) {
      const mm::StrainParts& parts = net.parts;
      to["edges_in_contact"] = parts.edges_in_contact;
      to["contacts_left_out"] = parts.contacts_left_out;
      to["sum"] = tensor(parts.sum());
      to["normal"] = tensor(parts.normal);
      to["elastic"] = tensor(parts.elastic);
      to["sliding"] = tensor(parts.sliding);
      to["rotation"] = tensor(parts.rotation);
      to["apart"] = tensor(parts.apart);
      to["published"] = tensor(parts.published());
    }
    nets.push_back(std::move(to));
  }
  return {{"rate", tensor(report.rate)}, {"nets", std::move(nets)}};
}

Json since_json(const StrainReport::Since& since) {
  Json nets = Json::array();
  for (const StrainOfNet& net : since.nets) {
    Json to = net_json(net);
    if (net.why_not.empty()) {
      to["sum"] = tensor(net.since.sum());
      for (const auto& [name, part] :
           {std::pair("kept", &net.since.kept), std::pair("lost", &net.since.lost),
            std::pair("gained", &net.since.gained), std::pair("apart", &net.since.apart)})
        to[name] = {{"gradient", tensor(part->gradient)}, {"edges", part->edges}};
    }
    nets.push_back(std::move(to));
  }
  return {{"since_cycle", since.cycle},
          {"since_time", since.time},
          {"gradient", tensor(since.gradient)},
          {"logarithmic", tensor(since.logarithmic)},
          {"nets", std::move(nets)}};
}

/// The symmetric part.
std::string row(const std::string& name, const Mat3& extension) {
  const Mat3 m = Mat3::Zero() - 0.5 * (extension + extension.transpose());
  std::string text = left(name);
  for (const double x : {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)}) text += cell(x);
  return text + "\n";
}

std::string head(const std::string& name) {
  std::string text = left(name);
  for (const char* column : {"xx", "yy", "zz", "xy", "yz", "zx"}) text += right(column);
  return text + "\n";
}

std::string head_of(const StrainOfNet& net) {
  if (!net.why_not.empty()) return net.name + ": " + net.why_not + "\n";
  return std::to_string(net.cells) + " " + net.name + ", " + std::to_string(net.edges) +
         " edges of " + std::to_string(net.centres) + " particles\n";
}

std::string rows_of(const mm::StrainParts& parts) {
  return row("  sum", parts.sum()) + row("  normal, of contacts", parts.normal) +
         row("  springs in shear", parts.elastic) + row("  sliding", parts.sliding) +
         row("  rotation of particles", parts.rotation) +
         row("  edges without contact", parts.apart) + row("  as published", parts.published());
}

std::string rows_of(const mm::StrainOfEdges& since) {
  const auto part = [](const char* name, const mm::StrainOfEdges::Part& of) {
    return row("  " + std::string(name) + ", " + std::to_string(of.edges), of.gradient);
  };
  return row("  sum", since.sum()) + part("contacts", since.kept) + part("lost", since.lost) +
         part("gained", since.gained) + part("no contact", since.apart);
}

}  // namespace

nlohmann::ordered_json strain_json(const StrainReport& report) {
  if (!report.why_not.empty()) return {{"why_not", report.why_not}};
  return {{"why_not", nullptr},
          {"velocities", velocities_json(report)},
          {"displacements", report.since ? since_json(*report.since) : Json(nullptr)}};
}

std::string strain_table(const StrainReport& report) {
  if (!report.why_not.empty()) return "Average strain: none, " + report.why_not + "\n";
  std::string text = head("Average strain rate") + row("cell", report.rate);
  for (const StrainOfNet& net : report.of_velocities)
    text += head_of(net) + (net.why_not.empty() ? rows_of(net.parts) : "");
  if (!report.since) return text;
  const StrainReport::Since& since = *report.since;
  text += "\n" + head("Since cycle " + std::to_string(since.cycle)) +
          row("cell, logarithmic", since.logarithmic) + row("cell, gradient", since.gradient);
  for (const StrainOfNet& net : since.nets)
    text += head_of(net) + (net.why_not.empty() ? rows_of(net.since) : "");
  return text;
}

const char* const kStrainHelp = R"(
Average strain, as a sum over the edges of a net that covers the cell: polygons between contacts
and triangles of centres in the plane, tetrahedra of centres in space; exactly that of the cell.
JSON, average_strain: why_not (null; else why there is none, as with walls) and
  velocities            What slides is known by the friction coefficient of the state's stage:
                        --friction where it is not that of the scene's contacts.
                        Rate of the cell, and of each net sum, and its parts: normal (contacts
                        become shorter), elastic (springs in shear), sliding, rotation (of
                        particles), apart (edges without contact); published (normal, elastic and
                        sliding: velocities at contacts with spins, which is not the strain of the
                        cell); cells, centres, edges, edges_in_contact, contacts_left_out (that are
                        no edge)
  displacements         with --since FILE, an earlier state of the same run, else null (a run of
                        the same particles from other places cannot be told from it):
                        since_cycle, since_time, gradient and logarithmic strain of the cell, and
                        of each net of the older state sum, and its parts of edges in contact at
                        both states (kept), at the older one (lost), at the later one (gained), at
                        neither (apart), each with its number of edges
Tensors are 3x3, compression positive: minus velocity or displacement gradients, not made symmetric;
the table has the symmetric part.
)";

}  // namespace tangency::inline v0::dem
