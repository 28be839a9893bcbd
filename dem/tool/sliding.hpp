// SPDX-License-Identifier: MIT
/// @file
/// How fast the contacts of a packing slide, by their laws.
///
/// The Coulomb limit c + F_n tan(phi) (contact_law.hpp) grows at the rate -tan(phi) K_n (v . n),
/// where v is the velocity of the second body relative to the first at the contact. A shear force
/// that is at the limit follows it, and what its spring does not take up of v is sliding
/// (micromechanics/average_strain.hpp, sliding_velocity). The shear force of a Hertz contact that
/// opens shrinks with its stiffness, and what shrinks does not slide. Of the two tangential
/// stiffnesses of a Hertz contact the larger one stands for both.
#pragma once

#include <span>
#include <vector>

#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/tool/packing.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// (1) Along the shear force it is what the contact's next step loses to sliding, as the step
///     becomes short; 0 where the force is not at the limit.
/// (2) Without a shear spring it is the whole tangential velocity.
/// @param laws      those of the packing
/// @param velocity  of the second body relative to the first at each contact, spins included
/// @return  how fast the second body of each contact slides over the first, length/time
std::vector<Vec3> sliding_of(const Packing& packing, const ContactLaws& laws,
                             std::span<const Vec3> velocity);

}  // namespace tangency::inline v0::dem
