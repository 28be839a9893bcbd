// SPDX-License-Identifier: GPL-2.0-or-later
// tangencyplugin.so: this project's styles for a LAMMPS that loads plugins, which the command
// `plugin load` names or the variable LAMMPS_PLUGIN_PATH finds.
#include <atom.h>
#include <error.h>
#include <lammps.h>
#include <lammpsplugin.h>
#include <library.h>
#include <version.h>

#include <cstdint>
#include <string>
#include <string_view>

#include <tangency/dem/lammps/styles.hpp>

namespace tangency::inline v0::lammps {
namespace {

/// What makes a style as LAMMPS passes it on: it casts it back before it calls.
void set_creator(lammpsplugin_t& plugin, const PairEntry& style) {
  plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1*>(style.create);
}

template <class Style>
void set_creator(lammpsplugin_t& plugin, const StyleEntry<Style, int, char**>& style) {
  plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2*>(style.create);
}

/// Objects go to and fro between this file and the program: they have to be laid out alike.
void require_same_layout(LAMMPS_NS::LAMMPS& lammps) {
  if (std::string_view(lammps.version) != LAMMPS_VERSION)
    lammps.error->all(FLERR, std::string("tangencyplugin.so was built for LAMMPS ") +
                                 LAMMPS_VERSION + ", and this is " + lammps.version +
                                 ": build it with the source of this one");
  const bool is_long = lammps.atom->extract_datatype("id") == LAMMPS_INT64;
  if (is_long != (sizeof(LAMMPS_NS::tagint) == sizeof(std::int64_t)))
    lammps.error->all(FLERR, std::string("tangencyplugin.so was built for atom IDs of ") +
                                 (is_long ? "32 bits, and this LAMMPS has those of 64: build it "
                                            "with -D LAMMPS_SIZES=bigbig"
                                          : "64 bits, and this LAMMPS has those of 32: build it "
                                            "with -D LAMMPS_SIZES=smallbig"));
}

void add_styles(void* lammps, void* handle, lammpsplugin_regfunc add) {
  const auto add_all = [&](const char* kind, const auto& styles) {
    for (const auto& style : styles) {
      lammpsplugin_t plugin{};
      plugin.version = LAMMPS_VERSION;
      plugin.style = kind;
      plugin.name = style.name;
      plugin.info = style.name;
      plugin.author = "Tangency";
      plugin.handle = handle;
      set_creator(plugin, style);
      add(&plugin, lammps);
    }
  };
  add_all("pair", pair_styles());
  add_all("fix", fix_styles());
  add_all("compute", compute_styles());
}

}  // namespace
}  // namespace tangency::inline v0::lammps

/// Called by LAMMPS when it has loaded the file.
/// @param lammps  its object
/// @param handle  of the file
/// @param add     a lammpsplugin_regfunc, which takes a style
extern "C" void lammpsplugin_init(void* lammps, void* handle, void* add) {
  tangency::lammps::require_same_layout(*static_cast<LAMMPS_NS::LAMMPS*>(lammps));
  tangency::lammps::add_styles(lammps, handle, reinterpret_cast<lammpsplugin_regfunc>(add));
}
