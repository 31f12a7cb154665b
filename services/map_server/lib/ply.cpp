#include "services/map_server/lib/ply.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <set>
#include <sstream>

namespace tsg {
namespace {

constexpr std::size_t kVertexBytes = 3 * sizeof(float) + 4;
static_assert(std::endian::native == std::endian::little, "vertices are written as they lie");

ClassId file_class(const CloudPoint& point) {
  return is_object_class(point.class_id) ? point.class_id : kBackgroundClass;
}

/// A class name comes from outside; a line break in it would end the comment.
std::string one_line(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < ' '; }, '?');
  return name;
}

std::string header_of(const Cloud& cloud, const ClassTable& classes) {
  std::set<ClassId> used;
  for (const CloudPoint& point : cloud) used.insert(file_class(point));
  std::ostringstream header;
  header << "ply\nformat binary_little_endian 1.0\n"
         << "comment coordinates in metres in the map frame: x forward, y left, z up\n";
  for (const ClassId id : used) {
    const Rgb colour = classes.colour_of(id);
    header << "comment class " << int{id} << ' ' << one_line(classes.name_of(id));
    if (id != kBackgroundClass) {
      header << ", colour " << int{colour.r} << ' ' << int{colour.g} << ' ' << int{colour.b};
    }
    header << '\n';
  }
  header << "element vertex " << cloud.size() << '\n';
  for (const char* axis : {"x", "y", "z"}) header << "property float " << axis << '\n';
  for (const char* field : {"red", "green", "blue", "class"}) {
    header << "property uchar " << field << '\n';
  }
  header << "end_header\n";
  return std::move(header).str();
}

}  // namespace

std::string to_ply(const Cloud& cloud, const ClassTable& classes) {
  std::string file = header_of(cloud, classes);
  std::size_t at = file.size();
  file.resize(at + cloud.size() * kVertexBytes);
  for (const CloudPoint& point : cloud) {
    const std::array<std::uint8_t, 4> bytes{point.colour.r, point.colour.g, point.colour.b,
                                            file_class(point)};
    std::memcpy(&file[at], point.position.data(), 3 * sizeof(float));
    std::memcpy(&file[at + 3 * sizeof(float)], bytes.data(), bytes.size());
    at += kVertexBytes;
  }
  return file;
}

}  // namespace tsg
