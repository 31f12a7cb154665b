#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tsg {

/// What a point or leaf is made of: 0 = background, 1..80 = the COCO classes in their usual order,
/// above = other names in the order in which they were first seen.
using ClassId = std::uint8_t;
inline constexpr ClassId kBackgroundClass = 0;
inline constexpr ClassId kOtherClass = 254;         ///< names beyond what 8 bits can number
inline constexpr ClassId kNotSegmentedClass = 255;  ///< seen without a mask: it may be anything

struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  bool operator==(const Rgb&) const = default;
};

/// True for ids that name a class of objects.
[[nodiscard]] constexpr bool is_object_class(ClassId id) {
  return id != kBackgroundClass && id != kNotSegmentedClass;
}

/// Colour of a class in maps; a function of the name alone, so that maps of different runs look
/// alike. COCO classes have one of 20 hues in one of four shades each: no two are the same.
[[nodiscard]] Rgb class_colour(std::string_view name);

/// Numbers class names. Owned by one map; ids are stable for its lifetime.
class ClassTable {
 public:
  ClassTable();

  /// The id of a name; a name never seen before gets the next free one.
  [[nodiscard]] ClassId id_of(std::string_view name);
  /// `id` must be background or come from id_of().
  [[nodiscard]] const std::string& name_of(ClassId id) const { return names_[id]; }
  [[nodiscard]] Rgb colour_of(ClassId id) const { return colours_[id]; }

 private:
  ClassId add(ClassId id, std::string_view name);

  int used_ = 0;
  std::array<std::string, 256> names_;
  std::array<Rgb, 256> colours_{};
};

}  // namespace tsg
