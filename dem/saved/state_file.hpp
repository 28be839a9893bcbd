// SPDX-License-Identifier: MIT
/// @file
/// Saved states: final.state and checkpoint.state.
///
/// A file holds, little-endian: the 8 bytes "TANGSTAT", a 32-bit version, the state, and the XXH3
/// of 64 bits of the state's bytes (docs/decisions/0011-state-hash.md). An array is its 64-bit
/// length and its items. All goes by in slices: beside the state itself reading and writing take
/// less than a megabyte. Doubles are stored bit for bit, the neighbour list and every contact with
/// them, so that a resumed run continues as if it had not been interrupted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include <tangency/dem/simulation.hpp>

namespace tangency::inline v0::dem {

/// A file that is no state this program can read; what() is one line that starts with its name.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes beside the file and renames: a failure leaves the old file as it was.
/// @throws WriteError
void save_state(const State& state, const std::filesystem::path& file);

/// @throws StateError
State load_state(const std::filesystem::path& file);

/// The cycle of the state in a file, without its contacts and unproven by its hash; nothing where
/// the file is no state of this version.
std::optional<std::int64_t> cycle_of_state(const std::filesystem::path& file);

/// The hash of a state, 16 hexadecimal digits: equal states, and in practice only they, have equal
/// hashes.
std::string state_hash(const State& state);

}  // namespace tangency::inline v0::dem
