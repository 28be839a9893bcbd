// SPDX-License-Identifier: MIT
/// @file
/// Saved states: final.state and checkpoint.state.
///
/// A file holds, little-endian: the 8 bytes "TANGSTAT", a 32-bit version, the state, and the
/// 64-bit FNV-1a hash of the state's bytes. Doubles are stored bit for bit, the neighbour list and
/// every contact with them, so that a resumed run continues as if it had not been interrupted.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <tangency/dem/simulation.hpp>

namespace tangency::dem {

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

/// The hash of a state, 16 hexadecimal digits: equal states, and in practice only they, have equal
/// hashes.
std::string state_hash(const State& state);

}  // namespace tangency::dem
