// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/box.hpp>

namespace tangency::inline v0::lammps {

Box Box::of(const LAMMPS_NS::Domain& domain) {
  Box box;
  box.low = Vec3(domain.boxlo[0], domain.boxlo[1], domain.boxlo[2]);
  const bool is_tilted = domain.triclinic != 0;
  box.edges << domain.xprd, is_tilted ? domain.xy : 0.0, is_tilted ? domain.xz : 0.0,  //
      0.0, domain.yprd, is_tilted ? domain.yz : 0.0,                                   //
      0.0, 0.0, domain.zprd;
  return box;
}

void Box::set(LAMMPS_NS::Domain& domain) const {
  for (int k = 0; k < 3; ++k) {
    domain.boxlo[k] = low[k];
    domain.boxhi[k] = low[k] + edges(k, k);
  }
  if (domain.triclinic != 0) {
    domain.xy = edges(0, 1);
    domain.xz = edges(0, 2);
    domain.yz = edges(1, 2);
  }
  domain.set_global_box();
  domain.set_local_box();
}

}  // namespace tangency::inline v0::lammps
