// SPDX-License-Identifier: MIT
#include <tangency/dem/tool/vtk_file.hpp>

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <new>
#include <numeric>
#include <type_traits>
#include <utility>

#include <tangency/dem/parallel.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

using tables::to_text;

/// Of the machine, and of the arrays that it writes; a reader turns them where its own is another.
constexpr const char* kByteOrder =
    std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// Bytes. Chosen: some 40 of a million particles' positions, which threads share; a smaller one
/// would compress worse.
constexpr std::size_t kBlock = std::size_t{1} << 19;

/// Measured on drawn places, orientations and velocities: the lowest level takes two thirds of the
/// time of the usual one and leaves 1 % more bytes, 114 a particle of 156.
constexpr int kLevel = Z_BEST_SPEED;

/// @param out  of ::compressBound(); empty where zlib finds no memory, all that can be wanting
void compress_block(std::string_view bytes, std::string& out) {
  uLongf size = out.size();
  const int result =
      ::compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), kLevel);
  out.resize(result == Z_OK ? size : 0);
}

void add_count(std::string& bytes, std::size_t count) {
  const auto number = static_cast<std::uint64_t>(count);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <class Number>
constexpr const char* vtk_type() {
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, float>) return "Float32";
  return "Int32";
}

}  // namespace

VtkPolyData::VtkPolyData(Cells cells, std::size_t points, std::string tensors)
    : cells_(cells), points_(points), tensors_(std::move(tensors)) {
  const std::size_t ends = cells == Cells::lines ? 2 : 1;
  std::vector<std::int32_t> connectivity(points), offsets(points / ends);
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (std::size_t k = 0; k < offsets.size(); ++k)
    offsets[k] = static_cast<std::int32_t>(ends * (k + 1));
  topology_ = array<std::int32_t>("connectivity", 1, connectivity);
  topology_ += array<std::int32_t>("offsets", 1, offsets);
}

std::string VtkPolyData::append(std::string_view bytes) {
  const std::size_t blocks = (bytes.size() + kBlock - 1) / kBlock;
  std::vector<std::string> parts(blocks, std::string(::compressBound(kBlock), '\0'));
  for_ranges(blocks, 2, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      compress_block(bytes.substr(k * kBlock, kBlock), parts[k]);
  });
  const std::string offset = to_text(appended_.size());
  // Number of blocks, size of each, of a last one that is not full, and of each when compressed.
  add_count(appended_, blocks);
  add_count(appended_, kBlock);
  add_count(appended_, bytes.size() % kBlock);
  for (const std::string& part : parts) {
    if (part.empty()) throw std::bad_alloc();
    add_count(appended_, part.size());
  }
  for (const std::string& part : parts) appended_ += part;
  return offset;
}

template <class Number>
std::string VtkPolyData::array(const std::string& name, int components,
                               std::span<const Number> values, const std::string& unit,
                               bool is_field) {
  const std::size_t items = values.size() / static_cast<std::size_t>(components);
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  return std::string("<DataArray type=\"") + vtk_type<Number>() + "\" Name=\"" + name +
         "\" NumberOfComponents=\"" + to_text(components) +
         (is_field ? "\" NumberOfTuples=\"" + to_text(items) : std::string()) +
         "\" format=\"appended\" offset=\"" + append(bytes) +
         (unit.empty() ? "\"/>\n"
                       : "\">\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" +
                             unit + "</InformationKey>\n</DataArray>\n");
}

void VtkPolyData::places(std::span<const double> values, const std::string& unit) {
  assert(values.size() == 3 * points_);
  places_ = array("Points", 3, values, unit);
}

void VtkPolyData::add(Of of, const std::string& name, int components,
                      std::span<const double> values, const std::string& unit) {
  data_[static_cast<std::size_t>(of)] += array(name, components, values, unit, of == Of::whole);
}

void VtkPolyData::add(Of of, const std::string& name, int components, std::span<const float> values,
                      const std::string& unit) {
  data_[static_cast<std::size_t>(of)] += array(name, components, values, unit, of == Of::whole);
}

void VtkPolyData::add(Of of, const std::string& name, int components,
                      std::span<const std::int32_t> values) {
  data_[static_cast<std::size_t>(of)] += array(name, components, values, "", of == Of::whole);
}

std::string VtkPolyData::text() const {
  const bool lines = cells_ == Cells::lines;
  const auto& [whole, points, cells] = data_;
  const auto element = [](const std::string& name, const std::string& attributes,
                          const std::string& inside) {
    return "<" + name + attributes + ">\n" + inside + "</" + name + ">\n";
  };
  const std::string tensors = tensors_.empty() ? "" : " Tensors=\"" + tensors_ + "\"";
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"" +
         std::string(kByteOrder) +
         "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n" +
         element("FieldData", "", whole) + "<Piece NumberOfPoints=\"" + to_text(points_) +
         "\" NumberOf" + (lines ? "Lines" : "Verts") + "=\"" +
         to_text(lines ? points_ / 2 : points_) + "\">\n" + element("PointData", tensors, points) +
         element("CellData", "", cells) + element("Points", "", places_) +
         element(lines ? "Lines" : "Verts", "", topology_) +
         "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + appended_ +
         "\n</AppendedData>\n</VTKFile>\n";
}

std::string vtk_collection(std::span<const VtkEntry> entries, const std::string& folder,
                           const std::string& ending) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const VtkEntry& entry : entries)
    text += "<DataSet timestep=\"" + to_text(entry.time) + "\" part=\"0\" file=\"" + folder + "/" +
            to_text(entry.cycle) + ending + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

std::optional<std::string> between(const std::string& line, const std::string& before,
                                   const std::string& after) {
  const std::size_t start = line.find(before);
  if (start == line.npos) return std::nullopt;
  const std::size_t end = line.find(after, start + before.size());
  if (end == line.npos) return std::nullopt;
  return line.substr(start + before.size(), end - start - before.size());
}

std::vector<VtkEntry> vtk_entries(std::istream& index, const std::string& folder,
                                  const std::string& ending) {
  std::vector<VtkEntry> entries;
  for (std::string line; std::getline(index, line);) {
    const auto time = between(line, "timestep=\"", "\"");
    const auto cycle = between(line, "file=\"" + folder + "/", ending + "\"");
    if (time && cycle) entries.push_back({std::stoll(*cycle), std::stod(*time)});
  }
  return entries;
}

}  // namespace tangency::inline v0::dem
