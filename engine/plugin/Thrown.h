// What a plugin's exception says, safely: its class comes from outside, so its text may be missing.
#pragma once

#include <exception>
#include <string_view>

namespace teren {

/// what(), or a substitute where it is a null pointer. As long as it likes: show it through `shortened`.
inline std::string_view textOf(const std::exception& exception) noexcept {
  const char* const text = exception.what();
  return text == nullptr ? std::string_view("an exception without a text") : std::string_view(text);
}

}  // namespace teren
