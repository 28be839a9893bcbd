// SPDX-License-Identifier: MIT
/// @file
/// Folders of a run's results in which each file is of one cycle: contacts/CYCLE.csv and
/// states/NAME.state. A run that is resumed keeps those up to its cycle.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tangency::inline v0::dem {

/// The cycle that a file is of; nothing for one of another kind.
using CycleOf = std::optional<std::int64_t>(const std::filesystem::path& file);
/// Of CYCLE.csv.
CycleOf cycle_of_contact_table;
/// Of NAME.state, which is read as far as it takes.
CycleOf cycle_of_kept_state;

/// Makes a folder of a run's results where there is none.
/// @throws WriteError
void make_folder(const std::filesystem::path& folder);

/// The first file of the kind in a folder, by its name.
std::optional<std::filesystem::path> first_file(const std::filesystem::path& folder,
                                                CycleOf& cycle_of);

/// Takes files of cycles after the last one away, and the folder where nothing is left in it.
void remove_later_files(const std::filesystem::path& folder, std::int64_t last_cycle,
                        CycleOf& cycle_of);

}  // namespace tangency::inline v0::dem
