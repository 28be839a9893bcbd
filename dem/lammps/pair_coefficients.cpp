// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/pair_coefficients.hpp>

#include <string>

#include <tangency/dem/lammps/words.hpp>

namespace tangency::inline v0::lammps {
namespace {

void read_tangential(Words& words, dem::ContactLaw& law) {
  const std::string kind = words.next("the kind of tangential, linear or mindlin");
  const std::string own = law.hertz ? "mindlin" : "linear";
  if (kind != own)
    words.refuse("tangential", kind, own + ", with " + (law.hertz ? "hertz/material" : "hooke"));
  // Of Mindlin's the stiffness goes with the contact: here it only says that there is one.
  law.shear_stiffness = law.hertz ? law.normal_stiffness : words.not_negative("kt");
  law.friction_coefficient = words.not_negative("mu");
}

}  // namespace

dem::ContactLaw law_of(Words& words) {
  dem::ContactLaw law{};
  const std::string normal = words.next("hooke or hertz/material");
  if (normal == "hooke") {
    law.normal_stiffness = words.positive("kn");
  } else if (normal == "hertz/material") {
    const double young = words.positive("E");
    law.hertz = dem::Material{young, words.within("nu", 0.0, 0.5, "a number from 0 to 0.5")};
    law.normal_stiffness = young;
  } else {
    words.refuse("law", normal, "hooke or hertz/material");
  }
  while (words.any()) {
    const std::string key = words.next("a keyword");
    if (key == "tangential") {
      read_tangential(words, law);
    } else if (key == "cohesion") {
      law.cohesion = words.not_negative(key);
    } else if (key == "restitution") {
      law.damping_ratio = dem::damping_ratio_of(
          words.within(key, dem::kLeastRestitution, 1.0, "a number from 0.05 to 1"));
    } else {
      words.refuse("keyword", key, "tangential, cohesion or restitution");
    }
  }
  return law;
}

StoredLaw stored(const dem::ContactLaw& law) {
  const dem::Material material = law.hertz.value_or(dem::Material{0.0, 0.0});
  return {law.normal_stiffness,   law.shear_stiffness,   law.friction_coefficient,
          law.cohesion,           law.damping_ratio,     law.hertz ? 1.0 : 0.0,
          material.young_modulus, material.poisson_ratio};
}

dem::ContactLaw restored(const StoredLaw& n) {
  dem::ContactLaw law{n[0], n[1], n[2], n[3], {}, n[4]};
  if (n[5] != 0.0) law.hertz = dem::Material{n[6], n[7]};
  return law;
}

}  // namespace tangency::inline v0::lammps
