// SPDX-License-Identifier: MIT
/// @file
/// Which instructions the kernel and the simulator compute with, and how to have the same bits with
/// any of them.
///
/// What runs in vector registers is compiled for several instruction sets, and the best one of the
/// processor is chosen when the program runs. Those with fused multiply-adds (AVX2, AVX-512) round
/// less often than those without, so that last bits, and with them the hash of a state, depend on
/// the processor.
#pragma once

#include <string>

namespace tangency::inline v0::dem {

/// The instruction set that is used: "AVX3" (AVX-512) with its extensions, "AVX2", "SSE4", "SSSE3",
/// or "SCALAR" where the processor has none of these. Thread-safe.
std::string instruction_set();

/// From now on this process uses, in the kernel too, instruction sets without fused multiply-adds
/// alone: SSE4 and what is below it, whose bits are the same. One scene then has one hash on every
/// x86-64 machine, but where the kernel's rare single calls (GapTier past fast) ask functions of
/// the C library whose bits depend on it. Slower, by how much: docs/simulator.md. Not while another
/// thread computes.
void use_reproducible_arithmetic();

/// Has it been called, and not been taken back?
bool uses_reproducible_arithmetic();

}  // namespace tangency::inline v0::dem

namespace tangency::inline v0::detail {

/// Takes back what use_reproducible_arithmetic() did: for tests, whose process has others beside
/// them. Not while another thread computes.
void use_every_instruction_set();

}  // namespace tangency::inline v0::detail
