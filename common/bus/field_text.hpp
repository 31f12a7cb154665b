#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

namespace tsg {

/// Text of a message's field of fixed size, up to its zero or its end.
template <std::size_t N>
std::string text_of(const char (&field)[N]) {  // NOLINT(*-avoid-c-arrays): the generated C type
  return {field, std::find(field, field + N, '\0')};
}

}  // namespace tsg
