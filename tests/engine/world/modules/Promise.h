// The ways in which the modules "hostile" and "liar" answer when asked for their range.
#pragma once

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include "teren/Plugin.h"

namespace hostile {

inline constexpr std::array<std::string_view, 8> kWays = {"sound",    "throws", "throws-int", "nan",
                                                          "infinite", "huge",   "reversed",   "negative"};

inline std::span<const teren::Parameter> parameters() noexcept {
  static constexpr std::array table = {teren::Parameter::choice("way", "sound", kWays, "what is wrong")};
  return table;
}

inline teren::HeightRange promise(const std::string& way) {
  if (way == "throws") throw std::runtime_error("two\nlines");
  if (way == "throws-int") throw 7;
  if (way == "nan") return {std::numeric_limits<double>::quiet_NaN(), 1.0, -1.0, 1.0};
  if (way == "infinite") return {0.0, 1.0, -1.0, std::numeric_limits<double>::infinity()};
  if (way == "huge") return {1e300, 1.0, -1e301, 1e301};
  if (way == "reversed") return {0.0, 1.0, 1.0, -1.0};
  if (way == "negative") return {0.0, -1.0, -1.0, 1.0};
  return {0.0, 1.0, -1.0, 1.0};
}

}  // namespace hostile
