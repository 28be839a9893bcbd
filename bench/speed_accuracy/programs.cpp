// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/programs.hpp>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace tangency::speed_accuracy {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "speed-accuracy-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": " + std::strerror(errno));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::add(const std::string& name, std::string_view text) const {
  const std::string path = (path_ / name).string();
  if (!(std::ofstream(path) << text)) throw std::runtime_error(path + ": cannot be written");
  return path;
}

std::string shell_word(std::string_view word) {
  std::string text = "'";
  for (const char c : word) c == '\'' ? text += "'\\''" : text += c;
  return text + "'";
}

std::string output_of(const std::string& command) {
  std::FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) throw std::runtime_error(command + ": " + std::strerror(errno));
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t read = std::fread(part.data(), 1, part.size(), output))
    text.append(part.data(), read);
  if (pclose(output) != 0) throw std::runtime_error(command + ": did not end with status 0");
  return text;
}

}  // namespace tangency::speed_accuracy
