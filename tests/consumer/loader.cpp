// SPDX-License-Identifier: GPL-3.0-or-later
// Usage: loader PLUGIN
// A program that knows nothing of the library and opens a plug-in that is made of it.
#include <dlfcn.h>

#include <cstdio>

int main(int count, char** words) {
  void* const plugin = count == 2 ? dlopen(words[1], RTLD_NOW | RTLD_LOCAL) : nullptr;
  if (plugin == nullptr) {
    std::fprintf(stderr, "%s\n", count == 2 ? dlerror() : "usage: loader PLUGIN");
    return 1;
  }
  const auto gap = reinterpret_cast<double (*)(double)>(dlsym(plugin, "plugin_gap"));
  const auto catches = reinterpret_cast<bool (*)()>(dlsym(plugin, "plugin_catches"));
  if (gap == nullptr || catches == nullptr) return 1;
  const bool answers = gap(1) == 3;
  std::printf("gap %s, exception %s\n", answers ? "right" : "wrong", catches() ? "caught" : "lost");
  return answers && catches() ? 0 : 1;
}
