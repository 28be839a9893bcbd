// SPDX-License-Identifier: MIT
/// @file
/// The force of a Hertz contact and how its ellipse shares the curvature, as rational functions.
/// Internal. docs/derivations/hertz-lanes.md has what f and g are and how far off these may be. No
/// function may stand here: the file is read by code for every instruction set.
///
/// Made by build/dev/tests/dem/hertz_fit (tests/dem/hertz_fit.cpp) with 70 digits; a test holds
/// these numbers against what it makes. z = tanh(L/8)^2, L the logarithm of the larger curvature
/// over the smaller, up to that of 2^14. The constant stands first.
#pragma once

namespace tangency::inline v0::dem {

/// f: the force is f E* overlap^(3/2) / sqrt(geometric mean of the curvatures); to a relative
/// 1.0e-16. In powers of z - kForceCentre, chosen: in the middle they cancel least.
inline constexpr double kForceCentre = 0x1.6p-2;
inline constexpr double kForceOver[] = {
    0x1.10b703c12d05cp+1, 0x1.ca89bac431f96p+1, -0x1.3cb5c85e691a6p+3, -0x1.047a70170bb21p+4,
    0x1.eb8c4f68fff74p+3, 0x1.81b350c0e324p+4,  -0x1.1e94dd7979e39p+3, -0x1.98075e59881f9p+3,
    0x1.7b878701d3f49p+0, 0x1.b1344e17da7dp+0};
inline constexpr double kForceUnder[] = {0x1p+0,
                                         0x1.6c1bb708507a1p-3,
                                         -0x1.b193ff1e9e4d6p+2,
                                         -0x1.209c22653e7c5p-1,
                                         0x1.043ff5651cd8ap+4,
                                         0x1.08eac1feb314cp-3,
                                         -0x1.0394c90f25b36p+4,
                                         0x1.553f7eadf256fp-1,
                                         0x1.76ca67012ae49p+2,
                                         -0x1.3a9b71cb208dbp-2,
                                         -0x1.8844f57a170e2p-2};

/// g: D/K = 1/2 + sqrt(z) g; to a relative 5.3e-17. In powers of z.
inline constexpr double kShareOver[] = {
    0x1.5555555555555p-1,  0x1.7aa10fb03a172p+2, 0x1.9a665c0c6d71dp+3, -0x1.855b2f3b98679p+3,
    -0x1.6e924734230e1p+5, 0x1.129f3d06a572cp+4, 0x1.8c0ecf3f4f0ffp+5, -0x1.55c778a78ece8p+4,
    -0x1.7d7f1b839afcap+3, 0x1.4615bc401faeap+2, 0x1.4b725e607ac09p-4, 0x1.0fd0154099e67p-4};
inline constexpr double kShareUnder[] = {0x1p+0,
                                         0x1.4a31af5264725p+3,
                                         0x1.e07ee01a2a0ecp+4,
                                         -0x1.f95ad23d26b4cp+1,
                                         -0x1.acee59fe573f1p+6,
                                         -0x1.7afb5fce6bd57p+4,
                                         0x1.229bfa559f369p+7,
                                         -0x1.b6cbb0d6bd993p+1,
                                         -0x1.0533ee77f72a4p+6,
                                         0x1.be2610b324336p+3,
                                         0x1.8e48328ff8abep+1};

}  // namespace tangency::inline v0::dem
