#include "common/map_file/map_file.hpp"

#include <zlib.h>

#include <cerrno>
#include <fstream>
#include <numeric>
#include <system_error>
#include <utility>

#include "common/core/atomic_file.hpp"
#include "common/map_file/bytes.hpp"

namespace tsg {
namespace {

namespace fs = std::filesystem;

// As PNG does it: a byte above 127 and a line end show what a transfer as text does to a file.
constexpr std::string_view kMagic("\x89TSGMAP\n", 8);
// Magic, version, checksum; then what the checksum covers: two sizes, information, map.
constexpr std::size_t kChecksumEnd = kMagic.size() + 2 * sizeof(std::uint32_t);
constexpr std::size_t kHeaderSize = kChecksumEnd + 2 * sizeof(std::uint64_t);
constexpr std::size_t kPartSize = sizeof(std::uint32_t) + 5 * sizeof(std::uint64_t);
constexpr const char* kTakeAnother = "; copy it again from where it was saved, or load another map";

std::string encode(const MapFileInfo& info) {
  ByteWriter out;
  out.put<std::int64_t>(info.created_ns);
  out.put<std::int32_t>(info.camera.width);
  out.put<std::int32_t>(info.camera.height);
  for (const double value : {info.camera.fx, info.camera.fy, info.camera.cx, info.camera.cy}) {
    out.put<double>(value);
  }
  for (const double value : info.camera.distortion) out.put<double>(value);
  out.put<std::uint32_t>(info.features.levels);
  out.put<double>(info.features.scale_factor);
  out.put<std::uint32_t>(info.features.pattern);
  out.put<std::uint64_t>(info.parts.size());
  for (const MapPartInfo& part : info.parts) {
    out.put<std::uint32_t>(part.part);
    out.put<std::uint64_t>(part.keyframes);
    out.put<std::uint64_t>(part.points);
    out.put(part.extent_m);
  }
  return out.take();
}

CameraModel decode_camera(ByteReader& in) {
  CameraModel camera;
  camera.width = in.get<std::int32_t>();
  camera.height = in.get<std::int32_t>();
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value = in.get<double>();
  for (double& value : camera.distortion) value = in.get<double>();
  for (const std::string& problem : camera.problems()) in.fail("camera: " + problem);
  return camera;
}

MapFileInfo decode_info(ByteReader& in) {
  MapFileInfo info;
  info.created_ns = in.get<std::int64_t>();
  info.camera = decode_camera(in);
  info.features.levels = in.get<std::uint32_t>();
  info.features.scale_factor = in.get<double>();
  info.features.pattern = in.get<std::uint32_t>();
  info.parts.resize(in.get_count(kPartSize));
  for (MapPartInfo& part : info.parts) {
    part.part = in.get<std::uint32_t>();
    part.keyframes = in.get<std::uint64_t>();
    part.points = in.get<std::uint64_t>();
    part.extent_m = in.get_vector();
  }
  if (in.left() > 0) in.fail("its description is longer than it should be");
  return info;
}

std::uint32_t checksum(std::uint32_t so_far, std::string_view bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  return static_cast<std::uint32_t>(crc32_z(so_far, data, bytes.size()));
}

tl::unexpected<Error> cannot_read(const fs::path& path, int error_number) {
  return make_error(ExitCode::kMissingInput, "cannot read the map file " + path.string() + ": " +
                                                 std::generic_category().message(error_number) +
                                                 "; check the path and its permissions");
}

tl::unexpected<Error> is_damaged(const fs::path& path, const std::string& how) {
  return make_error(ExitCode::kBadData,
                    "the map file " + path.string() + " is damaged: " + how + kTakeAnother);
}

tl::unexpected<Error> is_no_map(const fs::path& path, const std::string& why) {
  return make_error(ExitCode::kBadData, path.string() + " is no map file of TSG-SLAM: " + why +
                                            "; name a file that 'tsgctl map save' has written");
}

Expected<std::string> read_bytes(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return cannot_read(path, error ? error.value() : ENOENT);
  if (!fs::is_regular_file(status)) return is_no_map(path, "it is a folder or a device");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return cannot_read(path, error.value());
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) return cannot_read(path, errno);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.size() != size) return cannot_read(path, errno != 0 ? errno : EIO);
  return bytes;
}

/// What can be said without a look at the version that wrote it.
Expected<std::uint32_t> check_version(const fs::path& path, const std::string& bytes) {
  const std::string_view magic = std::string_view(bytes).substr(0, kMagic.size());
  if (magic.empty()) return is_no_map(path, "it is empty");
  if (magic != kMagic) return is_no_map(path, "it begins with other bytes");
  ByteReader in(std::string_view(bytes).substr(kMagic.size()));
  const auto version = in.get<std::uint32_t>();
  if (!in.is_ok() || version == 0) return is_damaged(path, "its version is missing");
  if (version > kMapFormatVersion) {
    return make_error(ExitCode::kBadData,
                      "the map file " + path.string() + " has format " + std::to_string(version) +
                          ", this program knows up to format " + std::to_string(kMapFormatVersion) +
                          ": load it with the TSG-SLAM that saved it, or a newer one");
  }
  return version;
}

}  // namespace

std::uint64_t MapFileInfo::keyframes() const {
  return std::accumulate(parts.begin(), parts.end(), std::uint64_t{0},
                         [](auto sum, const auto& part) { return sum + part.keyframes; });
}

std::uint64_t MapFileInfo::points() const {
  return std::accumulate(parts.begin(), parts.end(), std::uint64_t{0},
                         [](auto sum, const auto& part) { return sum + part.points; });
}

Expected<void> write_map_file(const fs::path& path, const MapFileInfo& info, std::string_view map) {
  const std::string description = encode(info);
  ByteWriter sizes;
  sizes.put<std::uint64_t>(description.size());
  sizes.put<std::uint64_t>(map.size());
  const std::string covered = sizes.take() + description;
  ByteWriter version_and_checksum;
  version_and_checksum.put<std::uint32_t>(kMapFormatVersion);
  version_and_checksum.put<std::uint32_t>(checksum(checksum(0, covered), map));
  const std::string header = std::string(kMagic) + version_and_checksum.take() + covered;
  return write_file_atomically(path, [&](std::ostream& stream) {
    stream.write(header.data(), static_cast<std::streamsize>(header.size()));
    stream.write(map.data(), static_cast<std::streamsize>(map.size()));
  });
}

Expected<MapFile> read_map_file(const fs::path& path) {
  auto bytes = read_bytes(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto version = check_version(path, *bytes);
  if (!version) return tl::unexpected(version.error());
  const std::string_view all = *bytes;
  if (all.size() < kHeaderSize) return is_damaged(path, "it is cut short");
  ByteReader header(all.substr(kMagic.size() + sizeof(std::uint32_t)));
  const auto expected = header.get<std::uint32_t>();
  const auto info_size = header.get<std::uint64_t>();
  const auto map_size = header.get<std::uint64_t>();
  const std::size_t rest = all.size() - kHeaderSize;
  // Without a sum of the two, which could overflow.
  if (info_size > rest || map_size != rest - info_size) {
    return is_damaged(
        path, "it has " + std::to_string(all.size()) + " bytes, more or less than its header says");
  }
  if (checksum(0, all.substr(kChecksumEnd)) != expected) {
    return is_damaged(path, "its content does not match its checksum");
  }
  ByteReader in(all.substr(kHeaderSize, static_cast<std::size_t>(info_size)));
  MapFile file;
  file.version = *version;
  file.info = decode_info(in);
  if (!in.is_ok()) return is_damaged(path, in.problem());
  file.map_begin = kHeaderSize + static_cast<std::size_t>(info_size);
  file.bytes = std::move(*bytes);
  return file;
}

}  // namespace tsg
