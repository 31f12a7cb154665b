#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "common/geometry/se3.hpp"

namespace tsg {

/// Numbers that a file can hold: their size is the same everywhere.
template <typename T>
concept FixedNumber = (std::integral<T> || std::floating_point<T>)&&!std::same_as<T, bool> &&
                      sizeof(T) <= 8;

template <std::size_t size>
using UnsignedOfSize = std::conditional_t<
    size == 1,
    std::uint8_t,
    std::conditional_t<size == 2,
                       std::uint16_t,
                       std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

/// Appends numbers to a string of bytes, little end first. The type is always named at the call:
/// it is the layout of the file.
class ByteWriter {
 public:
  template <FixedNumber T>
  void put(std::type_identity_t<T> value) {
    const auto bits = std::bit_cast<UnsignedOfSize<sizeof(T)>>(value);
    std::array<char, sizeof(T)> raw{};
    for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = static_cast<char>((bits >> (8 * i)) & 255);
    bytes_.append(raw.data(), raw.size());
  }
  void put(const Eigen::Vector3d& vector) {
    for (const double value : vector) put<double>(value);
  }
  void put(const SE3& T_a_b) {
    for (const double value : T_a_b.rotation().coeffs()) put<double>(value);
    put(T_a_b.translation());
  }

  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes numbers from bytes that may be damaged: never reads beyond the end. The first thing that
/// is wrong is kept as problem(); from then on every number is 0, so that it has to be asked for
/// once, at the end, and before a number decides how much memory is taken (get_count() sees to
/// that).
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <FixedNumber T>
  [[nodiscard]] T get() {
    using Bits = UnsignedOfSize<sizeof(T)>;
    if (!take(sizeof(T))) return T{};
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      const auto byte = static_cast<std::uint8_t>(bytes_[next_ - sizeof(T) + i]);
      bits = static_cast<Bits>(bits | static_cast<Bits>(static_cast<Bits>(byte) << (8 * i)));
    }
    return std::bit_cast<T>(bits);
  }
  [[nodiscard]] Eigen::Vector3d get_vector() {
    Eigen::Vector3d vector;
    for (double& value : vector) value = get<double>();
    return vector;
  }
  /// The very bits that were put; a problem where it is no rigid transform.
  [[nodiscard]] SE3 get_pose() {
    Eigen::Quaterniond rotation;
    for (double& value : rotation.coeffs()) value = get<double>();
    const Eigen::Vector3d translation = get_vector();
    const bool is_rigid = std::abs(rotation.norm() - 1.0) < kUnitTolerance;
    if (is_ok() && !(is_rigid && translation.allFinite())) fail("a pose is no rigid transform");
    return is_ok() ? SE3::of_unit_rotation(rotation, translation) : SE3();
  }
  /// A number of things that take at least `bytes_each` bytes: 0 where so many cannot follow.
  [[nodiscard]] std::size_t get_count(std::size_t bytes_each) {
    const auto count = get<std::uint64_t>();
    if (count <= left() / bytes_each) return static_cast<std::size_t>(count);
    fail("it announces " + std::to_string(count) + " things where " + std::to_string(left()) +
         " bytes are left");
    return 0;
  }

  void fail(std::string problem) {
    if (is_ok()) problem_ = std::move(problem);
  }
  [[nodiscard]] bool is_ok() const { return problem_.empty(); }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - next_; }

 private:
  static constexpr double kUnitTolerance = 1e-6;  // far above what arithmetic leaves of it

  bool take(std::size_t count) {
    if (!is_ok()) return false;
    if (count > left()) {
      fail("it ends in the middle");
      return false;
    }
    next_ += count;
    return true;
  }

  std::string_view bytes_;
  std::size_t next_ = 0;
  std::string problem_;
};

}  // namespace tsg
