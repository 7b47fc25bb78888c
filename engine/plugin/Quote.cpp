#include "teren/Quote.h"

#include <cstdint>

namespace teren {
namespace {

bool isContinuation(char c) {
  return (static_cast<std::uint8_t>(c) & 0xC0U) == 0x80U;
}

/// How many bytes the printable character at the front of `text` has; 0 where there is none.
std::size_t printableLength(std::string_view text) {
  const auto lead = static_cast<std::uint8_t>(text.front());
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (text.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if (!isContinuation(text[k])) return 0;
  }
  const auto second = static_cast<std::uint8_t>(text[1]);
  const bool control = lead == 0xC2 && second < 0xA0;
  const bool lineBreak =
      length == 3 && lead == 0xE2 && second == 0x80 &&
      (static_cast<std::uint8_t>(text[2]) == 0xA8 || static_cast<std::uint8_t>(text[2]) == 0xA9);
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool outside = (lead == 0xED && second > 0x9F) || (lead == 0xF4 && second > 0x8F);
  return control || lineBreak || overlong || outside ? 0 : length;
}

}  // namespace

std::string shortened(std::string_view text, std::size_t bytes) {
  std::string line;
  while (!text.empty()) {
    const std::size_t length = printableLength(text);
    if (line.size() + (length == 0 ? 1 : length) > bytes) return line + "...";
    if (length == 0) {
      line += '?';
    } else {
      line += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return line;
}

std::string inQuotes(std::string_view text) {
  return '"' + shortened(text) + '"';
}

}  // namespace teren
