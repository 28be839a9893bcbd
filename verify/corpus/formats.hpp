// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How a kind of corpus is written: its columns, the cells of an input, and the lines of its truth
/// behind row and family.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tangency/verify/families/families.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

/// None where the oracles prove nothing, and another input is drawn.
using TruthLines = std::vector<std::string>;

/// Cells of relation and inner.
std::string relation_cells(const ExactRelation& exact);
/// The cells of a body by centre, semi-axes and quaternion.
void append_body(std::string& line, const RawEllipsoid& body);

struct PairFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,"
      "b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz";
  static constexpr std::string_view truth =
      "relation,inner,size,gap,normals,nx,ny,nz,ax,ay,az,pw.gap,pw.nx,pw.ny,pw.nz,mp.gap,cl.gap";
  static constexpr std::string_view about =
      " Relation: exact, in integers (verify/oracles/relation.hpp).\n"
      "# Gap and normals: 40 digits of 150 (verify/oracles/gap.hpp, verify/corpus/"
      "coaxial.hpp), a line for every normal\n# that reaches the gap; pw, mp, cl:"
      " verify/oracles/perram_wertheim.hpp. Columns: verify/corpus/corpus.hpp.\n";
  static std::string input(const EllipsoidPair& pair);
  static TruthLines lines(const EllipsoidPair& pair);
};

struct FloatFormat {
  static constexpr std::string_view inputs = PairFormat::inputs;
  static constexpr std::string_view truth =
      "relation,inner,float.size,gap,normals,nx,ny,nz,ax,ay,az,pw.gap,pw.nx,pw.ny,pw.nz,mp.gap,"
      "cl.gap";
  static constexpr std::string_view about = PairFormat::about;
  static std::string input(const EllipsoidPair& pair) { return PairFormat::input(pair); }
  static TruthLines lines(const EllipsoidPair& pair);
};

struct MatrixFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.z,a.m.xx,a.m.yy,a.m.zz,a.m.xy,a.m.yz,a.m.zx,"
      "b.x,b.y,b.z,b.m.xx,b.m.yy,b.m.zz,b.m.xy,b.m.yz,b.m.zx";
  static constexpr std::string_view truth =
      "relation,inner,m.size,gap,normals,nx,ny,nz,ax,ay,az,pw.gap,pw.nx,pw.ny,pw.nz,mp.gap,cl.gap";
  static constexpr std::string_view about =
      " Relation: exact, in integers, for the entries as stored\n"
      "# (verify/oracles/shape_matrix.hpp); all else as of pairs. Columns: "
      "verify/corpus/corpus.hpp.\n";
  static std::string input(const MatrixPair& pair);
  static TruthLines lines(const MatrixPair& pair);
};

struct EllipseFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.r1,a.r2,a.ux,a.uy,b.x,b.y,b.r1,b.r2,b.ux,b.uy";
  static constexpr std::string_view truth =
      "relation,inner,crossings,size,area,smaller_area,gap,normals,nx,ny";
  static constexpr std::string_view about =
      " Relation and crossings: exact; area: 18 digits, rounded to\n# double; gap and normals:"
      " 40 digits of 150, a line for every normal that reaches the gap\n"
      "# (verify/oracles/ellipse.hpp). Columns: verify/corpus/corpus.hpp.\n";
  static std::string input(const EllipsePair& pair);
  static TruthLines lines(const EllipsePair& pair);
};

struct QuadricFormat {
  static constexpr std::string_view inputs = "A,B,C,D,E,F,G,H,J,K";
  static constexpr std::string_view truth = "type";
  static constexpr std::string_view about =
      " Types: exact, in integers (verify/oracles/classification.hpp).\n";
  static std::string input(const RawQuadric& q);
  static TruthLines lines(const RawQuadric& q);
};

struct PointFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,p.x,p.y,p.z";
  static constexpr std::string_view truth = "p.size,gap,normals,nx,ny,nz,ax,ay,az";
  static constexpr std::string_view about =
      " Gap and normals: 40 digits of 120\n# (verify/oracles/primitives.hpp), a line for every "
      "normal of a closest point. Columns: verify/corpus/corpus.hpp.\n";
  static std::string input(const BodyAndPoint& question);
  static TruthLines lines(const BodyAndPoint& question);
};

struct WallFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,w.nx,w.ny,w.nz,w.offset";
  static constexpr std::string_view truth = "relation,inner,w.size,gap,normals,nx,ny,nz,ax,ay,az";
  static constexpr std::string_view about =
      " Relation: exact, in rational numbers; gap and normal: 40\n"
      "# digits (verify/corpus/primitive_truth.hpp). Columns: verify/corpus/corpus.hpp.\n";
  static std::string input(const BodyAndWall& question);
  static TruthLines lines(const BodyAndWall& question);
};

struct RayFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,r.ox,r.oy,r.oz,r.dx,r.dy,r.dz";
  static constexpr std::string_view truth = "r.size,result,t1,t2";
  static constexpr std::string_view about =
      " Result: exact, in rational numbers; t1 and t2: 40 digits\n"
      "# (verify/corpus/primitive_truth.hpp). Columns: verify/corpus/corpus.hpp.\n";
  static std::string input(const BodyAndRay& question);
  static TruthLines lines(const BodyAndRay& question);
};

struct TimeFormat {
  static constexpr std::string_view inputs =
      "a.x,a.y,a.z,a.r1,a.r2,a.r3,a.qw,a.qx,a.qy,a.qz,a.vx,a.vy,a.vz,a.wx,a.wy,a.wz,"
      "b.x,b.y,b.z,b.r1,b.r2,b.r3,b.qw,b.qx,b.qy,b.qz,b.vx,b.vy,b.vz,b.wx,b.wy,b.wz,"
      "horizon,tolerance";
  static constexpr std::string_view truth = "tolerance,status,earliest,latest";
  static constexpr std::string_view about =
      " Proven by intervals (verify/oracles/time_of_contact.hpp); of\n"
      "# balls that do not turn, and at time 0, exact. Columns: verify/corpus/corpus.hpp.\n";
  static std::string input(const MovingPair& question);
  static TruthLines lines(const MovingPair& question);
};

}  // namespace tangency::inline v0::verify
