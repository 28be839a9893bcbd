# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D OUTPUT=FILE -D FOLDER=verify/corpora "-D NAMES=NAME;..." -P corpora_inside.cmake: a source
# that holds the tables of golden corpora, byte for byte, and no path of this machine:
# verify/answers/corpus_source.hpp.
cmake_minimum_required(VERSION 3.25)
file(STRINGS "${FOLDER}/VERSION" version LIMIT_COUNT 1)
set(texts "")
set(rows "")
set(number 0)
foreach(name IN LISTS NAMES)
  string(APPEND rows "    BuiltInCorpus{\"${name}\"")
  foreach(file "${name}.csv" "${name}.truth.csv")
    file(READ "${FOLDER}/${file}" text)
    string(FIND "${text}" ")csv\"" mark)
    if(NOT mark EQUAL -1)
      message(FATAL_ERROR "${FOLDER}/${file}: )csv\" must not stand in a corpus")
    endif()
    string(APPEND texts "constexpr char kText${number}[] = R\"csv(${text})csv\";\n")
    string(APPEND rows ", {kText${number}, sizeof kText${number} - 1}")
    math(EXPR number "${number} + 1")
  endforeach()
  string(APPEND rows "},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include <tangency/verify/answers/corpus_source.hpp>

#include <array>

namespace tangency::inline v0::verify {
namespace {

${texts}
constexpr std::array kCorpora{
${rows}};

}  // namespace

std::span<const BuiltInCorpus> built_in_corpora() { return kCorpora; }

std::string_view built_in_version() { return \"${version}\"; }

}  // namespace tangency::inline v0::verify
")
