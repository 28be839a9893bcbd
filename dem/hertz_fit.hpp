// SPDX-License-Identifier: MIT
/// @file
/// The force of a Hertz contact and how its ellipse shares the curvature, as rational functions.
/// Internal. docs/derivations/hertz-lanes.md has what f and g are and how far off these may be. No
/// function may stand here: the file is read by code for every instruction set.
///
/// Made by build/dev/tests/dem/hertz_fit (tests/dem/hertz_fit.cpp) with 70 digits; a test holds
/// these numbers against what it makes. Coefficients of powers of z = tanh(L/8)^2, L the logarithm
/// of the larger curvature over the smaller up to that of 2^14, the constant first.
#pragma once

namespace tangency::dem {

/// f: the force is f E* overlap^(3/2) / sqrt(geometric mean of the curvatures); to a relative
/// 1.0e-16.
inline constexpr double kForceOver[] = {
    0x1.5555555555556p+0,  0x1.59d4923a8227dp+3, 0x1.48c8c7fa8b84cp+4, -0x1.636b128b37ab9p+4,
    -0x1.02a629533e502p+6, 0x1.d23b7a52432a1p+4, 0x1.cd3e927d63d9ap+5, -0x1.a9e3e80a41cf1p+4,
    -0x1.4bf39fd163f34p+3, 0x1.2b5f4692ffc5dp+2};
inline constexpr double kForceUnder[] = {0x1p+0,
                                         0x1.b16986026dec5p+2,
                                         0x1.728b46711e2e8p+2,
                                         -0x1.e05c95af438acp+4,
                                         -0x1.5cacd47e5a65ap+4,
                                         0x1.e3209d8e4b738p+5,
                                         0x1.04938090b499cp+2,
                                         -0x1.49009b8a3f315p+5,
                                         0x1.a5e7c10835737p+3,
                                         0x1.6537c02dab26bp+1,
                                         -0x1.0f155ed5e1d6bp+0};

/// g: D/K = 1/2 + sqrt(z) g; to a relative 5.3e-17.
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

}  // namespace tangency::dem
